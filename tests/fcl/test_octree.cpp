/* SPDX-License-Identifier: MIT
 * test_octree.cpp: maps of voxels: their cells answer as the one solid that they are, characters walk over them, and a
 * broken file is refused with the byte or line. */
#include "voxels.h"
#include "worlds.h"

#include <octomap/OcTree.h>
#include <sstream>

static tahr_world *open_points(const std::vector<double> &points, double resolution,
                               const tahr_body_desc *body = nullptr)
{
    tahr_fcl_octree octree = {};
    tahr_fcl_desc fcl = {};
    octree.points = points.data();
    octree.point_count = static_cast<uint32_t>(points.size() / 3);
    octree.resolution = resolution;
    octree.body = body;
    fcl.struct_size = sizeof fcl;
    fcl.octree_count = 1;
    fcl.octrees = &octree;
    return open_fcl({}, &fcl);
}

static void add_block(std::vector<double> &points, const int low[3], const int high[3], double edge)
{
    for (int x = low[0]; x < high[0]; x++)
        for (int y = low[1]; y < high[1]; y++)
            for (int z = low[2]; z < high[2]; z++)
                points.insert(points.end(), {(x + 0.5) * edge, (y + 0.5) * edge, (z + 0.5) * edge});
}

static tahr_body_desc block_body(const int low[3], const int high[3], double edge)
{
    tahr_body_desc body = make_body(TAHR_BODY_BOX);
    body.pose.position = {0.5 * (low[0] + high[0]) * edge, 0.5 * (low[1] + high[1]) * edge,
                          0.5 * (low[2] + high[2]) * edge};
    body.half_extents = {0.5 * (high[0] - low[0]) * edge, 0.5 * (high[1] - low[1]) * edge,
                         0.5 * (high[2] - low[2]) * edge};
    return body;
}

/* A block whose sides are no powers of two is made of cells of many sizes. */
static const int block_low[3] = {-9, -7, -3}, block_high[3] = {11, 13, 2};

static void a_block_of_cells_is_a_box(void **)
{
    std::vector<double> points;
    tahr_body_desc pose = make_body(TAHR_BODY_BOX), box = block_body(block_low, block_high, 0.125);
    Dice dice = {1};
    int hits = 0;

    add_block(points, block_low, block_high, 0.125);
    for (int turned = 0; turned < 2; turned++) {
        if (turned) pose.pose = {{0.3, -0.2, 0.1}, dice.turn()};
        tahr_vec3 p = box.pose.position;
        tahr_quat q = pose.pose.orientation; /* the middle of the box, turned: p + 2 w (v x p) + 2 v x (v x p) */
        tahr_vec3 c = {q.y * p.z - q.z * p.y + q.w * p.x, q.z * p.x - q.x * p.z + q.w * p.y,
                       q.x * p.y - q.y * p.x + q.w * p.z};
        tahr_body_desc placed = box;
        placed.pose.orientation = q;
        placed.pose.position = {pose.pose.position.x + p.x + 2 * (q.y * c.z - q.z * c.y),
                                pose.pose.position.y + p.y + 2 * (q.z * c.x - q.x * c.z),
                                pose.pose.position.z + p.z + 2 * (q.x * c.y - q.y * c.x)};
        tahr_world *cells = open_points(points, 0.125, &pose), *native = open_native({placed});
        for (int i = 0; i < 3000; i++) {
            tahr_shape shape = round_shape(dice.uniform(0.1, 0.3), i % 2 ? 0 : 0.6);
            if (i % 2) shape.half_height = shape.radius;
            tahr_sweep s = make_sweep(shape, dice.vec(-2.5, 2.5), dice.vec(-2, 2));
            tahr_hit a, b;
            uint32_t found = sweep(native, s, &b);
            if (b.start_overlap) continue; /* the way out of cells leads along their axes */
            assert_int_equal(sweep(cells, s, &a), found);
            if (!found) continue;
            hits++;
            assert_true(same_stop(s, a, b));
            /* On a face; on edges and corners both may show another one of their faces. */
            if (apart(b.normal, b.surface_normal) < 1e-9) assert_true(apart(a.surface_normal, b.normal) < 1e-6);
        }
        tahr_world_close(cells);
        tahr_world_close(native);
    }
    assert_true(hits > 500);
}

static void distances_of_an_uneven_solid_are_those_of_its_boxes(void **)
{
    static const int low[3][3] = {{-20, -20, -2}, {0, -20, 0}, {-4, 4, 0}},
                     high[3][3] = {{20, 20, 0}, {20, 20, 3}, {0, 8, 11}};
    std::vector<double> points;
    std::vector<tahr_body_desc> bodies;
    Dice dice = {2};
    int near = 0;

    for (int i = 0; i < 3; i++) {
        add_block(points, low[i], high[i], 0.1);
        bodies.push_back(block_body(low[i], high[i], 0.1));
    }
    tahr_world *cells = open_points(points, 0.1), *native = open_native(bodies);
    for (int i = 0; i < 4000; i++) {
        tahr_vec3 at = {dice.uniform(-1.5, 1.5), dice.uniform(-1.5, 1.5), dice.uniform(0, 2.5)};
        tahr_contact_query q = make_contacts(round_shape(0.1, i % 2 ? 0.1 : 0.5), at, 0.3);
        tahr_contact contact = {};
        double truth = nearest(native, q, nullptr), got;
        if (truth < -0.09) continue; /* the core is in the solid */
        got = nearest(cells, q, &contact);
        near += truth < 1;
        assert_true(truth > 1 ? got > 1 : std::fabs(got - truth) < 1e-9);
    }
    assert_true(near > 500);
    tahr_world_close(cells);
    tahr_world_close(native);
}

static void no_seam_of_cells_is_felt_on_a_flat_floor_or_wall(void **)
{
    static const int floor_low[3] = {-40, -40, -3}, floor_high[3] = {40, 40, 0}, wall_low[3] = {-40, 10, 0},
                     wall_high[3] = {40, 13, 30};
    std::vector<double> points;
    Dice dice = {3};

    add_block(points, floor_low, floor_high, 0.1);
    add_block(points, wall_low, wall_high, 0.1);
    tahr_world *world = open_points(points, 0.1);
    for (int i = 0; i < 3000; i++) {
        /* On the seams and off them; at the margin or a micrometre inside it; to the floor, and to the wall too. */
        double above = i % 3 ? 0.01 : 0.01 - 1e-6,
               x = i % 2 ? dice.uniform(-2, 2) : 0.1 * std::floor(dice.uniform(-20, 20));
        double y = i % 5 ? dice.uniform(-2, 0) : 1 - 0.35 - above;
        tahr_sweep q = make_sweep(round_shape(0.35, 0.9), {x, y, 0.9 + above},
                                  {dice.uniform(-1, 1), i % 5 ? dice.uniform(-0.5, 0.5) : 0, 0});
        tahr_hit hit;
        assert_int_equal(sweep(world, q, &hit), 0);
    }
    tahr_world_close(world);
}

/* The block as one box is met where extents and points say (tests/unit/engines/test_ccd_shapes.c). */
static void characters_of_every_kind_meet_cells_as_their_box(void **)
{
    static const uint32_t kinds[] = {TAHR_SHAPE_CYLINDER, TAHR_SHAPE_CONE, TAHR_SHAPE_ELLIPSOID};
    std::vector<double> points;
    Dice dice = {6};
    int hits = 0, free = 0;

    add_block(points, block_low, block_high, 0.125);
    tahr_world *cells = open_points(points, 0.125),
               *whole = open_fcl({block_body(block_low, block_high, 0.125)}, nullptr);
    for (int i = 0; i < 2400; i++) {
        tahr_shape shape = {};
        tahr_hit a, b;
        shape.type = kinds[i % 3];
        shape.half_height = dice.uniform(0.2, 0.5);
        shape.radius = i % 3 < 2 ? dice.uniform(0.1, 0.3) : 0;
        shape.half_x = shape.half_y = i % 3 < 2 ? 0 : dice.uniform(0.1, 0.3);
        tahr_sweep s = make_sweep(shape, dice.vec(-2.5, 2.5), dice.vec(-2, 2));
        if (i % 2) { /* along the top, which is level at 0.25 m, a micrometre inside the margin or outside of it */
            s.position.z = 0.25 + shape.half_height + 0.01 + (i % 4 < 2 ? 1e-6 : -1e-6);
            s.motion.z = 0;
        }
        uint32_t found = sweep(whole, s, &b);
        if (found && b.start_overlap) continue; /* the way out of cells leads along their axes */
        assert_int_equal(sweep(cells, s, &a), found);
        hits += found != 0;
        free += !found;
        assert_true(!found || same_stop(s, a, b));
    }
    assert_true(hits > 100 && free > 100);
    tahr_world_close(cells);
    tahr_world_close(whole);
}

static void the_way_out_of_many_cells_leads_to_the_first_free_one(void **)
{
    static const int low[3] = {-50, -50, -8}, high[3] = {50, 50, 0};
    std::vector<double> points;
    tahr_contact contact = {};

    add_block(points, low, high, 0.1);
    tahr_world *world = open_points(points, 0.1);
    /* A sphere of 0.1 m, its centre 0.25 m below the top of 0.8 m: 0.35 m up. */
    assert_true(std::fabs(nearest(world, make_contacts(round_shape(0.1, 0.1), {0.02, 0.03, -0.25}, 0), &contact) +
                          0.35) < 1e-9);
    assert_true(contact.normal.z > 1 - 1e-12);
    /* Nearer to the bottom it is the other way: 0.2 m and the radius. */
    assert_true(std::fabs(nearest(world, make_contacts(round_shape(0.1, 0.1), {0.02, 0.03, -0.6}, 0), &contact) + 0.3) <
                1e-9);
    assert_true(contact.normal.z < -1 + 1e-12);
    tahr_world_close(world);
}

static void rays_meet_the_surface_and_nothing_inside(void **)
{
    std::vector<double> points;
    add_block(points, block_low, block_high, 0.125);
    tahr_world *world = open_points(points, 0.125);
    Dice dice = {4};

    for (int i = 0; i < 500; i++) {
        double x = i % 2 ? dice.uniform(-1.1, 1.3) : 0.125 * std::floor(dice.uniform(-8, 10)),
               y = dice.uniform(-0.8, 1.6);
        tahr_ray ray = {{x, y, 2}, {0, 0, -4}, 0xFFFFFFFFu, TAHR_NO_BODY};
        tahr_hit hit;
        uint32_t count;
        assert_int_equal(tahr_world_ray(world, &ray, &hit, &count), TAHR_OK);
        assert_int_equal(count, 1);
        assert_true(std::fabs(hit.fraction - 1.75 / 4) < 1e-9 && hit.normal.z > 1 - 1e-12 && hit.body == 0);
        ray.origin = {x, y, 0.01}; /* inside: out through the bottom nothing is met */
        assert_int_equal(tahr_world_ray(world, &ray, &hit, &count), TAHR_OK);
        assert_int_equal(count, 0);
    }
    tahr_world_close(world);
}

/* Walks along +x from rest; returns where it ends. */
static tahr_state walk(tahr_world *world, tahr_vec3 start, double seconds)
{
    tahr_config config;
    tahr_state state;
    tahr_mover *mover;
    tahr_input input = {};

    assert_int_equal(tahr_config_init(&config, sizeof config, TAHR_PRESET_PRECISE), TAHR_OK);
    config.max_speed = 2;
    assert_int_equal(tahr_state_init(&state, &config, &start), TAHR_OK);
    assert_int_equal(tahr_mover_create(world, &config, &mover), TAHR_OK);
    input.struct_size = sizeof input;
    input.move.x = 1;
    for (int i = 0; i < seconds * 60; i++)
        assert_true(tahr_mover_step(mover, &input, 1.0 / 60, &state, nullptr) >= 0);
    tahr_mover_destroy(mover);
    return state;
}

/* The same places as boxes on the native backend: what is walked there is what must be walked here. */
static void a_character_climbs_voxels_as_it_climbs_boxes(void **)
{
    std::vector<double> points = voxel_level();
    std::vector<tahr_body_desc> bodies;
    static const int floor_low[3] = {-60, -60, -2}, floor_high[3] = {60, 60, 0};

    bodies.push_back(block_body(floor_low, floor_high, VOXEL));
    for (int i = 0; i < 10; i++) {
        int low[3] = {10 + 3 * i, -40, 0}, high[3] = {60, -20, i + 1};
        bodies.push_back(block_body(low, high, VOXEL));
    }
    tahr_world *cells = open_points(points, VOXEL), *native = open_native(bodies);
    for (double y : {-3.0, -2.55, -3.449}) {
        tahr_state a = walk(cells, {0, y, 1}, 2.5), b = walk(native, {0, y, 1}, 2.5);
        /* 5 m less the time to fall and to get up to speed; robustness: 1e-2 of the way. */
        assert_true(a.position.z > 1.85 && a.position.x > 4);
        assert_true(apart(a.position, b.position) < 0.05);
    }
    tahr_world_close(cells);
    tahr_world_close(native);
}

/* --- Files --- */

static std::string save(const octomap::OcTree &tree, bool binary)
{
    std::ostringstream out;
    if (binary)
        const_cast<octomap::OcTree &>(tree).writeBinaryConst(out);
    else
        tree.write(out);
    return out.str();
}

static tahr_status open_bytes(const std::string &bytes, Log *log, tahr_world **world)
{
    char name[] = "/tmp/tahr_octree_XXXXXX";
    tahr_fcl_octree octree = {};
    tahr_fcl_desc fcl = {};
    int file = mkstemp(name);
    assert_true(file >= 0);
    FILE *stream = fdopen(file, "wb");
    assert_int_equal(fwrite(bytes.data(), 1, bytes.size(), stream), bytes.size());
    fclose(stream);
    octree.path = name;
    fcl.struct_size = sizeof fcl;
    fcl.octree_count = 1;
    fcl.octrees = &octree;
    tahr_status status = try_open(tahr_backend_v1_fcl(), {}, &fcl, log, world);
    remove(name);
    return status;
}

static octomap::OcTree small_tree()
{
    octomap::OcTree tree(0.25);
    for (int i = -4; i < 5; i++)
        for (int j = -4; j < 4; j++)
            tree.updateNode(0.25 * i + 0.125, 0.25 * j + 0.125, i % 3 ? -0.125 : 0.125, true);
    return tree;
}

static void files_of_both_kinds_and_points_give_the_same_bits(void **)
{
    octomap::OcTree tree = small_tree();
    std::vector<double> points;
    tahr_world *worlds[3];
    Dice dice = {5};

    for (auto i = tree.begin_leafs(); i != tree.end_leafs(); ++i)
        points.insert(points.end(), {i.getX(), i.getY(), i.getZ()});
    worlds[0] = open_points(points, 0.25);
    for (int k = 0; k < 2; k++)
        assert_int_equal(open_bytes(save(tree, k == 0), nullptr, &worlds[1 + k]), TAHR_OK);
    for (int i = 0; i < 300; i++) {
        tahr_sweep q = make_sweep(round_shape(0.2, 0.5), dice.vec(-1.5, 1.5), dice.vec(-1, 1));
        tahr_hit a, b;
        uint32_t found = sweep(worlds[0], q, &a);
        for (int k = 1; k < 3; k++) {
            assert_int_equal(sweep(worlds[k], q, &b), found);
            assert_memory_equal(&a, &b, sizeof a);
        }
    }
    for (tahr_world *world : worlds)
        tahr_world_close(world);
}

static void a_file_that_ends_early_is_refused_at_every_byte(void **)
{
    for (int binary = 0; binary < 2; binary++) {
        std::string bytes = save(small_tree(), binary != 0);
        for (size_t size = 0; size < bytes.size(); size++) {
            Log log;
            tahr_world *world;
            assert_int_equal(open_bytes(bytes.substr(0, size), &log, &world), TAHR_E_GEOMETRY);
            assert_null(world);
            assert_true(log.text.find("octree '") != std::string::npos);
        }
    }
}

static void broken_files_say_where_and_never_crash(void **)
{
    const std::string head = "# Octomap OcTree binary file\nid OcTree\nsize 1\nres 0.1\ndata\n";
    const struct {
        std::string bytes;
        const char *says;
    } cases[] = {
        {"hello\n", "line 1: expected"},
        {"# Octomap OcTree binary file\nid ColorOcTree\nres 0.1\ndata\n", "line 2: expected 'id OcTree'"},
        {"# Octomap OcTree binary file\nid OcTree\nres -1\ndata\n", "'res'"},
        {"# Octomap OcTree binary file\nid OcTree\nres nan\ndata\n", "'res'"},
        {head, "byte"},
        {head + std::string(2, '\0'), "no cell is occupied"},
        {head + std::string(400000, '\xff'), "deeper than 16 levels"},
    };
    const std::string whole[2] = {save(small_tree(), false), save(small_tree(), true)};
    Dice dice = {6};

    for (const auto &c : cases) {
        Log log;
        tahr_world *world;
        assert_int_equal(open_bytes(c.bytes, &log, &world), TAHR_E_GEOMETRY);
        if (log.text.find(c.says) == std::string::npos) print_message("    %s\n", log.text.c_str());
        assert_true(log.text.find(c.says) != std::string::npos);
    }
    for (int i = 0; i < 300; i++) {
        std::string bytes = whole[i % 2];
        tahr_world *world;
        for (int k = 0; k < 3; k++)
            bytes[static_cast<size_t>(dice.uniform(0, static_cast<double>(bytes.size())))] =
                static_cast<char>(dice.uniform(-128, 127));
        open_bytes(bytes, nullptr, &world);
        tahr_world_close(world);
    }
}

static void points_and_files_out_of_range_are_named(void **)
{
    const double far[3] = {1e9, 0, 0}, here[3] = {0, 0, 0}, nowhere[3] = {NAN, 0, 0};
    const struct {
        tahr_fcl_octree octree;
        tahr_status status;
        const char *says;
    } cases[] = {
        {{"/nonexistent.bt", nullptr, 0, 0, 0, nullptr}, TAHR_E_NOT_FOUND, "cannot be opened"},
        {{nullptr, far, 1, 0, 0.1, nullptr}, TAHR_E_GEOMETRY, "points[0]"},
        {{nullptr, nowhere, 1, 0, 0.1, nullptr}, TAHR_E_GEOMETRY, "points[0]"},
        {{nullptr, here, 1, 0, 1e-9, nullptr}, TAHR_E_ARGUMENT, "resolution"},
        {{nullptr, here, 0, 0, 0.1, nullptr}, TAHR_E_ARGUMENT, "points"},
    };

    for (const auto &c : cases) {
        tahr_fcl_desc fcl = {};
        tahr_world *world;
        Log log;
        fcl.struct_size = sizeof fcl;
        fcl.octree_count = 1;
        fcl.octrees = &c.octree;
        assert_int_equal(try_open(tahr_backend_v1_fcl(), {}, &fcl, &log, &world), c.status);
        assert_true(log.text.find(c.says) != std::string::npos);
    }
}

int main()
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_block_of_cells_is_a_box),
        cmocka_unit_test(distances_of_an_uneven_solid_are_those_of_its_boxes),
        cmocka_unit_test(no_seam_of_cells_is_felt_on_a_flat_floor_or_wall),
        cmocka_unit_test(characters_of_every_kind_meet_cells_as_their_box),
        cmocka_unit_test(the_way_out_of_many_cells_leads_to_the_first_free_one),
        cmocka_unit_test(rays_meet_the_surface_and_nothing_inside),
        cmocka_unit_test(a_character_climbs_voxels_as_it_climbs_boxes),
        cmocka_unit_test(files_of_both_kinds_and_points_give_the_same_bits),
        cmocka_unit_test(a_file_that_ends_early_is_refused_at_every_byte),
        cmocka_unit_test(broken_files_say_where_and_never_crash),
        cmocka_unit_test(points_and_files_out_of_range_are_named),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
