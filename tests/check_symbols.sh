#!/bin/sh
# check_symbols.sh: what the built libraries export, need and keep. BUILD is the build folder.
#   exports: exactly what a public header declares; nothing internal leaves the shared object
#   needs:   libc, sqrt, floor, fabs of libm, dlopen of src/plugin.c, and what src/plugin_file.c looks at a plugin with;
#            else no I/O, clock, randomness, threads or other mathematics (bits differ there)
#   keeps:   no mutable globals
set -eu

library=
for file in "$BUILD"/lib/libtahr.so; do [ -e "$file" ] && library=$file; done
if [ -z "$library" ]; then
    echo "SKIP: house_symbols: the shared library was not built"
    exit 77
fi
for tool in nm objdump; do
    command -v $tool >/dev/null 2>&1 && continue
    echo "SKIP: house_symbols: $tool is missing"
    exit 77
done
failed=0

# report TEXT LIST: an error if the list is not empty.
report() {
    [ -z "$2" ] && return 0
    printf '%s: %s\n' "$1" "$(printf '%s' "$2" | tr '\n' ' ')"
    failed=1
}

# One declaration a line, with the public headers' own functions only.
declarations=$(for header in include/tahr/*.h; do echo "#include <tahr/${header##*/}>"; done |
    "${CC:-cc}" -E -P -Iinclude -x c - | tr '\n' ' ' | tr ';}' '\n\n' |
    sed -nE 's/.*visibility\("default"\).*\b(tahr_[a-z0-9_]+) ?\(.*/\1/p' | sort -u)
exported=$(nm -D --defined-only "$library" | awk '{ print $NF }' | grep -vE '^_(init|fini)$' | sort -u)
report "exported, but in no public header" "$(printf '%s\n' "$exported" | grep -vxF "$declarations" || true)"
# The entries of other backends, and what belongs to one of them, are in libraries of their own.
report "declared, but not exported" "$(printf '%s\n' "$declarations" | grep -vxF "$exported" |
    grep -vE '^tahr_((backend_v1|trace|threads|telemetry|lcm)_|message_name$)' || true)"

for plugin in "$BUILD"/lib/libtahr_*.so; do
    [ -e "$plugin" ] || continue
    name=${plugin##*/libtahr_}
    report "exported by a backend beside its entries, and in no public header" "$(nm -D --defined-only "$plugin" |
        awk '{ print $NF }' | grep -vxE "tahr_backend_v1(_${name%.so})?|_init|_fini" | grep -vxF "$declarations" || true)"
done

allowed='malloc|calloc|realloc|free|aligned_alloc|posix_memalign|mem(cpy|set|cmp|move|chr)|str(len|n?cmp|chr)|v?snprintf'
allowed="$allowed|strpbrk|strstr|dl(open|sym|close|error)|sqrt|floor|fabs|fegetround|abort|__stack_chk_fail|__(mem(cpy|set|move)|v?snprintf)_chk"
allowed="$allowed|__(cxa_finalize|gmon_start__)|_ITM_.*|_Unwind_.*"
files='f(open|read|seek|close)|stat'
report "needed, but not promised" "$(nm -D --undefined-only "$library" | awk '{ sub(/@.*/, "", $NF); print $NF }' |
    grep -vxE "$allowed|$files" || true)"
report "files touched outside of src/plugin_file.c" "$(nm -A --undefined-only "$BUILD/lib/libtahr.a" |
    grep -E "[ .](__)?($files)(64|_chk)?\$" | grep -v ':plugin_file\.c\.o' || true)"

# "address flags section<tab>size name"; a name with a leading dot is the section's own.
report "mutable globals" "$(objdump -t "$BUILD/lib/libtahr.a" | awk -F '\t' 'NF == 2 {
    words = split($2, right, " ") # size, perhaps ".hidden", name
    section = $1
    sub(/.* /, "", section)
    if (section ~ /^(\*COM\*|\.(data|bss|tdata|tbss)(\.|$))/ && section !~ /^\.data\.rel\.ro/ && right[words] !~ /^\./)
        print right[words]
}')"

[ $failed = 0 ] && echo "symbols: $(printf '%s\n' "$exported" | wc -l) exported, all of them declared"
exit $failed
