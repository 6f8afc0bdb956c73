/* SPDX-License-Identifier: MIT
 * mutant.h: the native backend with one promise broken at a time: what the conformance kit must not let pass. */
#ifndef TAHR_TEST_MUTANT_H
#define TAHR_TEST_MUTANT_H

#include <tahr/backend.h>

/* X(constant, the case that must catch it) */
#define MUTANT_TABLE(X)                                              \
    X(MUTANT_NONE, "")                                               \
    X(LATE_BY_A_MILLIMETRE, "stops_at_margin")                       \
    X(EARLY_BY_A_MILLIMETRE, "stops_at_margin")                      \
    X(NORMAL_FLIPPED, "stops_without_margin")                        \
    X(NORMAL_NOT_UNIT, "unit_normals_against_the_motion")            \
    X(NORMAL_OF_AN_AXIS, "vertex_normals")                           \
    X(NORMAL_ALWAYS_UP, "overlap_with_walls_and_slopes")             \
    X(BLOCKS_PARALLEL_MOTION, "parallel_motion_is_free")             \
    X(BLOCKS_PARALLEL_MOTION_IN_ITS_SLOP, "parallel_motion_is_free") \
    X(BLOCKS_MOTION_ALONG_WALLS, "parallel_to_a_wall_is_free")       \
    X(BLOCKS_SEPARATING_MOTION, "separating_motion_is_free")         \
    X(BLOCKS_WITHOUT_MOTION, "rest_at_margin")                       \
    X(FREE_AT_THE_MARGIN, "rest_at_margin_minus_one_ulp")            \
    X(FREE_JUST_OUTSIDE_THE_MARGIN, "rest_1e-6_around_margin")       \
    X(FREE_A_MILLIMETRE_OUTSIDE, "rest_1e-3_around_margin")          \
    X(LEVEL_MOTIONS_ENTER_THE_MARGIN, "rest_at_margin")              \
    X(LEVEL_MOTIONS_MISS_WHAT_IS_NEAR, "rest_1e-6_around_margin")    \
    X(FREE_WHEN_TOUCHING, "touch")                                   \
    X(MARGIN_IGNORED, "stops_at_margin")                             \
    X(MARGIN_ALONG_THE_MOTION, "grazing_1_degree")                   \
    X(GRAZES_MISSED, "grazing_0.1_degree")                           \
    X(SEES_BEYOND_THE_MOTION, "stops_only_within_the_motion")        \
    X(DISTANCE_NOT_SAID, "stop_distance_and_point")                  \
    X(OVERLAP_NOT_REPORTED, "overlap_at_start")                      \
    X(DEPTH_DOUBLED, "overlap_at_start")                             \
    X(LEAVE_OVERLAP_IGNORED, "leave_overlap")                        \
    X(SURFACE_NORMAL_IS_CONTACT_NORMAL, "edge_normals")              \
    X(SURFACE_NORMAL_ALWAYS_UP, "edge_from_the_side")                \
    X(WIDER_BY_A_MILLIMETRE, "passes_an_edge")                       \
    X(WALLS_BEFORE_FLOORS, "inner_corner")                           \
    X(SEAMS_ARE_FELT, "seams_of_blocks")                             \
    X(SEAMS_BLOCK, "seams_of_triangles")                             \
    X(FAST_MOTIONS_TUNNEL, "thin_wall_at_high_speed")                \
    X(BACK_FACES_BLOCK, "one_sided_sheet")                           \
    X(TWO_SIDED_IGNORED, "two_sided_sheet")                          \
    X(DEGENERATE_REFUSED, "degenerate_triangles")                    \
    X(DUPLICATES_CANCEL, "duplicate_triangles")                      \
    X(POSITIONS_IN_FLOAT, "far_origin_1e6")                          \
    X(GRID_OF_MILLIMETRES, "far_origin_1e4")                         \
    X(ABSOLUTE_TOLERANCE, "tiny_scale_1e-2")                         \
    X(ABSOLUTE_MARGIN, "tiny_scale_1e-3")                            \
    X(MOTIONS_CLAMPED, "huge_scale_1e3")                             \
    X(SPHERE_IS_A_CAPSULE, "shape_sphere")                           \
    X(CAPSULE_IS_A_BOX, "shape_capsule")                             \
    X(BOX_IS_A_CAPSULE, "shape_box")                                 \
    X(YAW_IGNORED, "shape_box_turned")                               \
    X(UP_IS_ALWAYS_Z, "shape_lying")                                 \
    X(BOXES_HALF_AS_HIGH, "body_box")                                \
    X(SPHERES_ARE_BOXES, "body_sphere")                              \
    X(CAPSULES_WITHOUT_CAPS, "body_capsule")                         \
    X(MESHES_SHIFTED, "body_mesh")                                   \
    X(HULLS_SHIFTED, "body_hull")                                    \
    X(HEIGHTS_SHIFTED, "body_heights")                               \
    X(IMMERSION_HALVED, "fluid_immersion")                           \
    X(CONTACT_DISTANCE_UNSIGNED, "contact_distance")                 \
    X(CONTACT_NORMAL_FLIPPED, "contact_distance")                    \
    X(CONTACT_MARGIN_DOUBLED, "contact_margin")                      \
    X(CONTACTS_WITHOUT_FEATURES, "contact_distance")                 \
    X(CONTACTS_NAME_ANOTHER_TRIANGLE, "tie_by_feature")              \
    X(CONTACTS_IN_WRONG_ORDER, "contact_order_and_capacity")         \
    X(TRUNCATION_NOT_SAID, "contact_order_and_capacity")             \
    X(WRITES_BEYOND_CAPACITY, "contact_order_and_capacity")          \
    X(CONTACTS_FORGET_THE_NEAREST, "contacts_agree_with_sweeps")     \
    X(HIGHEST_BODY_OF_A_TIE, "tie_by_body")                          \
    X(HIGHEST_FEATURE_OF_A_TIE, "tie_by_feature")                    \
    X(RAYS_A_MILLIMETRE_LATE, "ray")                                 \
    X(RAYS_WITHOUT_FEATURES, "ray")                                  \
    X(RAYS_NAME_ANOTHER_TRIANGLE, "tie_by_feature")                  \
    X(RAYS_IGNORE_MASKS, "mask_of_rays")                             \
    X(EMPTY_WORLD_HAS_A_FLOOR, "empty_world")                        \
    X(ANSWERS_ALTERNATE, "same_question_same_bits")                  \
    X(CACHE_CHANGES_BITS, "cache_changes_no_bit")                    \
    X(PREPARE_CHANGES_BITS, "prepare_changes_no_bit")                \
    X(NAN_GIVES_NINE_ANSWERS, "nan_input")                           \
    X(NAN_GIVES_NINE_CONTACTS, "nan_input")                          \
    X(NAN_GIVES_NINE_RAYS, "nan_input")                              \
    X(FRACTION_IS_NAN, "stops_at_margin")                            \
    X(FRACTION_IS_MINUS_ONE, "stops_at_margin")                      \
    X(ALWAYS_UNKNOWN, "stops_at_margin")                             \
    X(SEVENTH_BODY_IS_MISSED, "random_sweeps_among_blocks")          \
    X(SEVENTH_BODY_HAS_NO_CONTACTS, "random_contacts_among_blocks")  \
    X(WALKS_THROUGH_WALLS, "a_walk_in_one_look_is_its_sweeps")       \
    X(WALKS_OFF_BY_ROUNDING, "a_walk_in_one_look_is_its_sweeps")     \
    X(FALLS_THROUGH_FLOORS, "a_walk_in_one_look_is_its_sweeps")      \
    X(SEES_NOTHING_TOO_FAR, "a_walk_in_one_look_is_its_sweeps")      \
    X(MASK_IGNORED, "mask")                                          \
    X(IGNORE_BODY_IGNORED, "ignore_body")                            \
    X(ONLY_BODY_IGNORED, "only_body")                                \
    X(SURFACE_DATA_LOST, "surface_data")                             \
    X(SENSORS_BLOCK, "sensors_let_pass")                             \
    X(SENSORS_FORGOTTEN, "sensors_in_order_and_truncated")           \
    X(SENSORS_IN_WRONG_ORDER, "sensors_in_order_and_truncated")      \
    X(SENSORS_BEHIND_THE_WALL, "sensors_in_order_and_truncated")     \
    X(SENSORS_FLAG_IGNORED, "sensors_only")                          \
    X(CONTACTS_FORGET_WHO_IS_A_SENSOR, "sensors_in_contacts")        \
    X(PLACING_IGNORED, "placed_body")                                \
    X(RAYS_LOSE_PLACED_BODIES, "placed_body")                        \
    X(CONTACTS_LOSE_PLACED_BODIES, "placed_body")

enum {
#define MUTANT_ENUM(constant, name) constant,
    MUTANT_TABLE(MUTANT_ENUM)
#undef MUTANT_ENUM
        MUTANT_COUNT
};

/* For tahr_world_desc.options of its worlds. */
typedef struct mutant_desc {
    uint32_t struct_size;
    uint32_t which;
} mutant_desc;

const tahr_backend *mutant_backend(void);
const char *mutant_name(uint32_t which);
const char *mutant_case(uint32_t which); /* that must catch it */

#endif
