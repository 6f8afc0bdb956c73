/* SPDX-License-Identifier: MIT
 * trace.c: see trace.h. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "trace.h"

void trace_note(trace *t, const rig *r)
{
    assert_int_equal(r->report.decisions_lost, 0);
    for (uint32_t i = 0; i < r->report.decision_count; i++) {
        const tahr_decision *d = &r->decisions[i];
        assert_true(d->reason && d->accepted <= 1 && strcmp(tahr_rule_name(d->rule), "?") != 0);
        assert_true(isfinite(d->value) && isfinite(d->limit));
        for (int k = 0; k < t->count; k++) {
            trace_row *row = &t->rows[k];
            row->seen += row->rule == d->rule && row->accepted == d->accepted && strcmp(row->reason, d->reason) == 0;
        }
    }
}

void trace_step(trace *t, rig *r)
{
    rig_step(r, 1.0 / 60);
    trace_note(t, r);
}

void trace_steps(trace *t, rig *r, int n, tahr_vec3 move)
{
    r->input.move = move;
    for (int i = 0; i < n; i++) {
        trace_step(t, r);
    }
}

void trace_check(const trace *t, uint32_t first, uint32_t last)
{
    uint32_t rules = 0, missing = 0;
    for (int k = 0; k < t->count; k++) {
        const trace_row *row = &t->rows[k];
        if (!row->seen) {
            print_error("never %s: %s, %s\n", row->accepted ? "accepted" : "rejected", tahr_rule_name(row->rule),
                        row->reason);
            missing++;
        }
        rules |= 1u << row->rule;
    }
    for (uint32_t rule = first; rule <= last; rule++) {
        if (!(rules & 1u << rule)) {
            print_error("no row tells of %s\n", tahr_rule_name(rule));
            missing++;
        }
    }
    assert_int_equal(missing, 0);
}
