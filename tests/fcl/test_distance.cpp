/* SPDX-License-Identifier: MIT
 * test_distance.cpp: the core distance of contacts against FCL's own unsigned distance, the mesh first (its answers are
 * wrong in the other order), within FCL's tolerance. */
#include "meshes.h"

#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/distance.h>

/* FCL answers with the distance of two points that it found on the shapes, so never with less than the truth (but for
 * rounding). On spheres and boxes it is exact; on the round ends of a capsule its iteration stops early. */
static const double ASKED = 1e-6, ROUNDING = 1e-9, EARLY = 1e-3;
static const double REACH = 3; /* m, of contacts */

static double fcl_distance(const fcl::CollisionGeometry<double> &of, const fcl::CollisionGeometry<double> &shape,
                           tahr_vec3 at)
{
    fcl::DistanceRequest<double> request(false, false, 0, 0, ASKED, fcl::GST_LIBCCD);
    fcl::DistanceResult<double> result;
    fcl::Transform3<double> pose = fcl::Transform3<double>::Identity();

    pose.translation() << at.x, at.y, at.z;
    fcl::distance<double>(&of, fcl::Transform3<double>::Identity(), &shape, pose, request, result);
    return result.min_distance;
}

static void compare(tahr_world *world, const fcl::CollisionGeometry<double> &of, int seed, bool is_capsule)
{
    const fcl::Sphere<double> sphere(0.3);
    const fcl::Capsule<double> capsule(0.3, 1.2);
    const fcl::Box<double> box(0.6, 0.4, 1.2);
    const fcl::CollisionGeometry<double> *shapes[3] = {&sphere, &capsule, &box};
    tahr_shape own[3] = {round_shape(0.3, 0.3), round_shape(0.3, 0.9), {}};
    Dice dice = {static_cast<uint64_t>(seed)};
    int compared = 0;
    double worst[3] = {0, 0, 0};

    own[2].type = TAHR_SHAPE_BOX;
    own[2].half_x = 0.3;
    own[2].half_y = 0.2;
    own[2].half_height = 0.6;
    for (int i = 0; i < 900; i++) {
        tahr_vec3 at = {dice.uniform(-3.5, 3.5), dice.uniform(-3.5, 3.5), dice.uniform(-1.5, 3)};
        double ours = nearest(world, make_contacts(own[i % 3], at, REACH), nullptr);
        if (ours > REACH || ours < 0.001) continue; /* overlapping FCL says -1 or 0 */
        double theirs = fcl_distance(of, *shapes[i % 3], at);
        compared++;
        if (std::fabs(ours - theirs) > worst[i % 3]) worst[i % 3] = std::fabs(ours - theirs);
        assert_true(theirs >= ours - ROUNDING);
        assert_true(theirs <= ours + (i % 3 == 1 || (is_capsule && i % 3 == 2) ? EARLY : ROUNDING));
    }
    print_message("    %d compared, worst %.1e m (sphere), %.1e m (capsule), %.1e m (box)\n", compared, worst[0],
                  worst[1], worst[2]);
    assert_true(compared > 300);
}

static void distances_to_a_mesh_are_those_of_fcl(void **)
{
    Dice dice = {21};
    Hills hills(dice);
    tahr_world *world = open_fcl({hills.body()}, nullptr);
    compare(world, *hills.model<fcl::OBBRSS<double>>(), 22, false);
    tahr_world_close(world);
}

static void distances_to_solids_are_those_of_fcl(void **)
{
    tahr_body_desc body = make_body(TAHR_BODY_BOX);
    body.half_extents = {1, 0.5, 0.25};
    tahr_world *world = open_fcl({body}, nullptr);
    compare(world, fcl::Box<double>(2, 1, 0.5), 23, false);
    tahr_world_close(world);
    body = make_body(TAHR_BODY_CAPSULE);
    body.radius = 0.5;
    body.half_height = 1.25;
    world = open_fcl({body}, nullptr);
    compare(world, fcl::Capsule<double>(0.5, 1.5), 24, true);
    tahr_world_close(world);
}

int main()
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(distances_to_a_mesh_are_those_of_fcl),
        cmocka_unit_test(distances_to_solids_are_those_of_fcl),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
