/* SPDX-License-Identifier: MIT
 * wide_collect.h: all items of a tree that a box meets, for a file that has said how a node is met (meets, one bit per
 * child), and how the numbers of bits are written, from a first one on (put_bits, how many; there is room for eight).
 * Hardly a branch hangs on what is found: each that is not foreseen costs as much as a look at a node does. */

static inline uint32_t wide_collect(const tahr__wide *tree, const tahr__wide_box *box, uint32_t *items,
                                    uint32_t capacity)
{
    uint32_t stack[TAHR__WIDE_STACK + TAHR__WIDE], top = 1, count = 0;
    stack[0] = 0;
    while (top > 0 && count <= capacity) {
        const tahr__wide_node *n = &tree->nodes[stack[--top]];
        const uint32_t near = meets(n, box), whole = n->base[1] >> 29;
        const uint32_t found = put_bits(whole ? items + count : stack + top, n->first, near);
        count += whole ? found : 0;
        top += whole ? 0 : found;
#if defined(__GNUC__)
        /* The next but one; what comes next is asked for at once. */
        if (top > 1) __builtin_prefetch(&tree->nodes[stack[top - 2]]);
#endif
    }
    return count;
}
