#!/bin/sh
# thread_sanitizer.sh: the pool and telemetry, and the tests that use them from several threads at once, under
# ThreadSanitizer. It does not know fences: every word that two threads share is an atomic, so that it needs none. CC
# is the compiler; libtahr, of which telemetry needs the hash of a state, comes from BUILD.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

skip() {
    echo "SKIP: house_thread_sanitizer: $1"
    exit 77
}
printf '#include <pthread.h>\nstatic void *f(void *p) { return p; }\nint main(void) {\n
    pthread_t t;\n    return pthread_create(&t, 0, f, 0) || pthread_join(t, 0);\n}\n' >"$folder/probe.c"
compiler=
for tool in "${CC:-cc}" clang gcc; do
    command -v "$tool" >/dev/null 2>&1 || continue
    "$tool" -fsanitize=thread "$folder/probe.c" -o "$folder/probe" -pthread >/dev/null 2>&1 || continue
    compiler=$tool
    "$folder/probe" >"$folder/log" 2>&1 && break
    compiler=
done
[ -n "$compiler" ] || skip "no compiler whose ThreadSanitizer runs here"
cmocka=$(pkg-config --cflags --libs cmocka 2>/dev/null) || skip "pkg-config does not find cmocka"

# gcc warns of the fences. Without SSE2, so that what other processors have is run somewhere, too.
flags="-std=c11 -O1 -g -U__SSE2__ -fsanitize=thread -D_POSIX_C_SOURCE=200809L -DTAHR_HAVE_THREADS"
case $("$compiler" --version) in *"Free Software Foundation"*) flags="$flags -Wno-tsan" ;; esac
flags="$flags -I$PWD/include -I$PWD/backends -I$PWD/tests/unit"
sources=$(ls "$PWD"/backends/threads/*.c)
# shellcheck disable=SC2086
(cd "$folder" && "$compiler" $flags -c $sources "$OLDPWD/tests/unit/listener.c")
for test in telemetry/test_ring telemetry/test_steps telemetry/test_order telemetry/test_latest telemetry/test_stop \
    crowd/test_threads; do
    # shellcheck disable=SC2086
    "$compiler" $flags "tests/unit/$test.c" "$folder"/*.o "$BUILD/lib/libtahr.a" $cmocka -lm -ldl -pthread \
        -o "$folder/test"
    "$folder/test" >"$folder/log" 2>&1 || { cat "$folder/log"; exit 1; }
    grep -E 'PASSED' "$folder/log" | sed "s|^|$compiler: $test: |"
done
