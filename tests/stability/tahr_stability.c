#include "run.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
int main(int argc, char **argv)
{
    const char *fam = argc > 1 ? argv[1] : "all", *sub = argc > 2 ? argv[2] : "all";
    int n = argc > 3 ? atoi(argv[3]) : 50;
    for (const family *f = FAMILIES; f->name; f++) {
        if (strcmp(fam, "all") && strcmp(fam, f->name)) continue;
        for (const subject *s = SUBJECTS; s->name; s++) {
            if (strcmp(sub, "all") && strcmp(sub, s->name)) continue;
            for (uint32_t p = 1; p <= 3; p++) {
                const char *why; outcome o, firsto; int fails = 0; uint64_t seed1 = 0; measure m = {0}; double slow = 0;
                if (!run_possible(f, s, p, &why)) continue;
                if (argc > 5 && (int)p != atoi(argv[5])) continue;
                for (uint64_t seed = argc > 4 ? (uint64_t)n : 1; seed <= (uint64_t)n; seed++) {
                    run_request q = {f, s, p, seed, argc > 4 && atoi(argv[4])};
                    run(&q, &o);
                    if (o.first.kept && fails++ == 0) firsto = o, seed1 = seed;
                    if (o.worst.deepest > m.deepest) m.deepest = o.worst.deepest;
                    if (o.worst.used > m.used) m.used = o.worst.used;
                    if (o.worst.queries > m.queries) m.queries = o.worst.queries;
                    m.steps += o.worst.steps; m.walking += o.worst.walking; m.errors += o.worst.errors;
                    if (o.slowest > slow) slow = o.slowest;
                }
                printf("%-13s %-13s %-10s %4d/%d deep %.1e used %.2g q %u walk %.0f%% err %u %.0f us", f->name, s->name, tahr_preset_name((int)p), n - fails, n, m.deepest, m.used, m.queries, 100.0*m.walking/(m.steps+1e-9), m.errors, slow*1e6);
                if (fails) printf("  seed %llu step %d %s %.3g > %.3g: %s", (unsigned long long)seed1, firsto.first.step, watch_name(firsto.first.kept), firsto.first.value, firsto.first.bound, firsto.first.text);
                printf("\n"); fflush(stdout);
            }
        }
    }
}
