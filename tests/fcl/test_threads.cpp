/* SPDX-License-Identifier: MIT
 * test_threads.cpp: queries of one world on several threads at once give the bits that they give one after the other,
 * with FCL's trees already built, also after bodies were placed. */
#include "meshes.h"

#include <thread>

enum { THREADS = 4, QUERIES = 400 };

static void ask(tahr_world *world, std::vector<tahr_hit> *hits)
{
    Dice dice = {51};
    for (int i = 0; i < QUERIES; i++) {
        tahr_sweep q = make_sweep(round_shape(0.3, i % 2 ? 0.3 : 0.9), dice.vec(-3, 3), dice.vec(-1, 1));
        tahr_hit hit = {};
        uint32_t count = 0;
        if (tahr_world_sweep(world, &q, &hit, 1, &count) != TAHR_OK) return;
        hits->push_back(hit);
    }
}

static void queries_on_several_threads_give_the_same_bits(void **)
{
    Dice dice = {50};
    Hills hills(dice);
    std::vector<tahr_body_desc> bodies = {hills.body()};
    for (int i = 0; i < 50; i++) {
        bodies.push_back(make_body(TAHR_BODY_BOX));
        bodies.back().flags = TAHR_BODY_MOVABLE;
        bodies.back().half_extents = {0.2, 0.3, 0.1};
        bodies.back().pose = {dice.vec(-3, 3), dice.turn()};
    }
    for (uint32_t search : {TAHR_FCL_DESCEND, TAHR_FCL_COLLIDE}) {
        tahr_fcl_desc desc = {};
        desc.struct_size = sizeof desc;
        desc.volumes = TAHR_FCL_OBBRSS;
        desc.search = search;
        tahr_world *world = open_fcl(bodies, &desc);
        tahr_body_pose pose = {1, 0, {{0, 0, 1}, {0, 0, 0, 1}}};
        assert_int_equal(tahr_world_set(world, &pose, 1), TAHR_OK);
        std::vector<tahr_hit> alone, together[THREADS];
        std::vector<std::thread> threads;
        ask(world, &alone);
        for (auto &hits : together)
            threads.emplace_back(ask, world, &hits);
        for (auto &thread : threads)
            thread.join();
        assert_int_equal(alone.size(), QUERIES);
        for (const auto &hits : together) {
            assert_int_equal(hits.size(), QUERIES);
            assert_memory_equal(hits.data(), alone.data(), QUERIES * sizeof(tahr_hit));
        }
        tahr_world_close(world);
    }
}

int main()
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(queries_on_several_threads_give_the_same_bits)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
