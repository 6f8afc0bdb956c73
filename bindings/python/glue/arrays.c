/* SPDX-License-Identifier: MIT
 * arrays.c: what Python would do one by one, for whole arrays; and the backends inside. */
#include "glue.h"

tahr_status glue_states_init(const tahr_config *config, const double *places, size_t count, tahr_state *states,
                             size_t *done)
{
    tahr_status status = TAHR_OK;
    for (*done = 0; *done < count; (*done)++) {
        const double *p = places + 3 * *done;
        const tahr_vec3 place = {p[0], p[1], p[2]};
        status = tahr_state_init(&states[*done], config, &place);
        if (status < 0) break;
    }
    return status;
}

void glue_states_hash(const tahr_state *states, size_t count, uint64_t *hashes)
{
    for (size_t i = 0; i < count; i++) {
        hashes[i] = tahr_state_hash(&states[i]);
    }
}

const tahr_backend *glue_backend(uint32_t index)
{
    static const tahr_backend_fn backends[] = {
        tahr_backend_v1_native,
#ifdef TAHR_HAVE_CCD
        tahr_backend_v1_ccd,
#endif
#ifdef TAHR_HAVE_FCL
        tahr_backend_v1_fcl,
#endif
#ifdef TAHR_HAVE_BOX2D
        tahr_backend_v1_box2d,
#endif
    };
    return index < sizeof backends / sizeof *backends ? backends[index]() : NULL;
}
