#!/bin/sh
# build.sh: builds tahr_peers and, one by one, the engines that it runs beside Tahr. One that cannot be built is left
# out: FOLDER/lib/peer_NAME.reason says why, in one line, and tahr_peers prints it.
# Usage: tests/bench/peers/build.sh FOLDER [more arguments for CMake], from the root of the sources
set -eu
folder=${1:?usage: tests/bench/peers/build.sh FOLDER [arguments for CMake]}
shift
mkdir -p "$folder/lib" "$folder/log"
folder=$(cd "$folder" && pwd)
crate=tests/bench/peers/rust
jobs=${JOBS:-2}

leave_out() {
    echo "peers: $1 is left out: $2"
    echo "$2" >"$folder/lib/peer_$1.reason"
    rm -f "$folder/lib/peer_$1.so"
}

# What to say of a log that ends in a failure.
last_error() {
    grep -iE 'error' "$1" | tail -n 1 | cut -c 1-300 | grep . || tail -n 1 "$1" | cut -c 1-300
}

# The crates: Rapier and PhysX, and one that carries Jolt's sources. The processor's vectors as the other engines get
# them: AVX2 where there is an x86-64.
export CARGO_TARGET_DIR="$folder/rust" CARGO_BUILD_JOBS="$jobs" CARGO_NET_RETRY=1
case $(uname -m) in
x86_64)
    export RUSTFLAGS="${RUSTFLAGS--C target-cpu=x86-64-v3}" CXXFLAGS="${CXXFLAGS--march=x86-64-v3}"
    ;;
esac
# The crate of PhysX asks for clang++; another compiler does as well.
command -v clang++ >/dev/null 2>&1 || export CXX="${CXX:-c++}"
cargo=
if ! command -v cargo >/dev/null 2>&1; then
    no_cargo="cargo is missing"
elif ! cargo fetch --locked --manifest-path $crate/Cargo.toml </dev/null >"$folder/log/fetch" 2>&1; then
    no_cargo="cargo fetch failed: $(last_error "$folder/log/fetch")"
else
    cargo=yes
fi

jolt=
if [ $cargo ]; then
    jolt=$(cargo metadata --locked --offline --format-version 1 --features jolt --manifest-path $crate/Cargo.toml |
        tr ',' '\n' | sed -n 's|.*"manifest_path":"\(.*/joltc-sys[^"]*\)/Cargo.toml".*|\1/JoltC/JoltPhysics|p' | head -n 1)
    [ -d "$jolt/Jolt" ] || jolt=
fi

generator=
if [ ! -f "$folder/cmake/CMakeCache.txt" ] && command -v ninja >/dev/null 2>&1; then
    generator='-G Ninja'
fi
# shellcheck disable=SC2086
cmake -S . -B "$folder/cmake" $generator -DCMAKE_BUILD_TYPE=Release -DTAHR_PEERS=ON -DTAHR_TESTS=OFF -DTAHR_CLI=OFF \
    -DTAHR_SHARED=OFF -DTAHR_BACKEND_FCL=OFF -DTAHR_JOLT_DIR="$jolt" "$@" >"$folder/log/cmake" 2>&1 || {
    cat "$folder/log/cmake"
    exit 1
}
echo "peers: building tahr_peers"
cmake --build "$folder/cmake" --parallel "$jobs" --target tahr_peers >"$folder/log/tahr_peers" 2>&1 || {
    cat "$folder/log/tahr_peers"
    exit 1
}
cp "$folder/cmake/bin/tahr_peers" "$folder/"

# take NAME FILE: what was built takes its place.
take() {
    rm -f "$folder/lib/peer_$1.reason"
    cp "$2" "$folder/lib/peer_$1.so"
}

# by_cmake NAME WHY: a target of peers.cmake; WHY it is not there, if it is not.
by_cmake() {
    if ! cmake --build "$folder/cmake" --target help | grep -qw "peer_$1"; then
        leave_out "$1" "$2"
        return
    fi
    echo "peers: building $1"
    if cmake --build "$folder/cmake" --parallel "$jobs" --target "peer_$1" >"$folder/log/$1" 2>&1; then
        take "$1" "$folder/cmake/lib/peer_$1.so"
    else
        leave_out "$1" "it does not compile: $(last_error "$folder/log/$1")"
    fi
}

# by_cargo NAME MINUTES: a feature of the crate.
by_cargo() {
    if [ ! $cargo ]; then
        leave_out "$1" "$no_cargo"
        return
    fi
    echo "peers: building $1 (the first time takes about $2 minutes)"
    if cargo build --release --locked --offline --manifest-path $crate/Cargo.toml --features "$1" \
        </dev/null >"$folder/log/$1" 2>&1; then
        take "$1" "$folder/rust/release/libtahr_peers.so"
    else
        leave_out "$1" "it does not compile: $(last_error "$folder/log/$1")"
    fi
}

by_cmake bullet "Bullet was not found (libbullet-dev)"
by_cmake box2d "the sources of Box2D 3 were not found (TAHR_BOX2D3_DIR, make setup)"
by_cmake jolt "${no_cargo:-the crate joltc-sys holds no sources of Jolt, or there is no C++ compiler}"
by_cargo rapier 3
by_cargo physx 6
