/* SPDX-License-Identifier: MIT
 * test_trace.cpp: a recording from C++ is the file that C writes, and ends when its owner does. */
#include "cpp_test.hpp"

#include <cstdio>
#include <cstdlib>
#include <unistd.h>

#include <tahr/trace.hpp>

/* A file of the test's own, removed again. */
struct scratch {
    std::string path;
    scratch()
    {
        const char *folder = getenv("TMPDIR");
        path = std::string(folder ? folder : "/tmp") + "/tahr_cpp_XXXXXX";
        int file = mkstemp(path.data());
        assert_true(file >= 0);
        close(file);
    }
    ~scratch()
    {
        remove(path.c_str());
    }
    std::string bytes() const
    {
        std::string all;
        char block[4096];
        FILE *file = fopen(path.c_str(), "rb");
        assert_non_null(file);
        for (size_t n; (n = fread(block, 1, sizeof block, file)) > 0;)
            all.append(block, n);
        fclose(file);
        return all;
    }
};

static std::string recorded_by_c()
{
    scratch file;
    tahr::world world = open_floor();
    tahr::mover mover = tahr::mover::create(world, precise()).value();
    tahr_trace_desc desc{};
    desc.struct_size = sizeof desc;
    desc.path = file.path.c_str();
    tahr_trace *trace = nullptr;
    assert_int_equal(tahr_trace_open(&desc, &trace), TAHR_OK);
    assert_int_equal(tahr_world_record(world.handle(), tahr_trace_recorder(trace)), TAHR_OK);
    (void)walk(mover);
    assert_int_equal(tahr_world_record(world.handle(), nullptr), TAHR_OK);
    assert_int_equal(tahr_trace_close(trace), TAHR_OK);
    return file.bytes();
}

static void recording_is_the_file_of_c(void **)
{
    scratch file;
    tahr::world world = open_floor();
    tahr::mover mover = tahr::mover::create(world, precise()).value();
    tahr::trace trace = tahr::trace::record(world, file.path.c_str()).value();
    tahr::trace moved = std::move(trace);
    (void)walk(mover);
    assert_int_equal(moved.close().value(), TAHR_OK);
    assert_int_equal(moved.close().value(), TAHR_OK);
    (void)walk(mover); /* watched no more */
    std::string bytes = file.bytes(), expected = recorded_by_c();
    assert_true(bytes.size() > 1000);
    assert_true(bytes == expected);
}

static void recordings_end_in_any_order(void **)
{
    scratch first_file, second_file, third_file;
    tahr::trace survivor;
    {
        tahr::world world = open_floor();
        tahr::mover mover = tahr::mover::create(world, precise()).value();
        tahr::trace first = tahr::trace::record(world, first_file.path.c_str()).value();
        tahr::trace second = tahr::trace::record(world, second_file.path.c_str()).value();
        assert_int_equal(first.close().value(), TAHR_OK); /* and leaves the second one its world */
        (void)walk(mover);
        survivor = std::move(second);
        {
            tahr::world other = open_floor();
            tahr::trace dropped = tahr::trace::record(other, third_file.path.c_str()).value();
        }
    }
    assert_int_equal(survivor.close().value(), TAHR_OK);
    assert_true(second_file.bytes() == recorded_by_c());
    assert_true(third_file.bytes().size() > 0);
}

static void file_that_cannot_be_written_is_named(void **)
{
    tahr::world world = open_floor(), none;
    scratch file;
    assert_says(tahr::trace::record(world, "/nonexistent/folder/bug.trace"), TAHR_E_FILE, "/nonexistent/folder");
    assert_says(tahr::trace::record(world, nullptr), TAHR_E_NULL, "path is NULL");
    assert_says(tahr::trace::record(none, file.path.c_str()), TAHR_E_NULL, "tahr_world_record");
}

int main()
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(recording_is_the_file_of_c),
        cmocka_unit_test(recordings_end_in_any_order),
        cmocka_unit_test(file_that_cannot_be_written_is_named),
    };
    return cmocka_run_group_tests(tests, nullptr, nullptr);
}
