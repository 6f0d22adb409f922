#!/usr/bin/env bash
# Install to an empty place, move it, then build and run foreign projects that find it there:
# one in C++ and one in C, by find_package and by pkg-config.
# Usage: install_test.sh BUILD_FOLDER SCRATCH_FOLDER VERSION
set -euo pipefail
here=$(cd -- "$(dirname -- "$0")" && pwd)
build=$1 scratch=$2 version=$3
prefix=$scratch/prefix

rm -rf "$scratch"
mkdir -p "$scratch"
cmake --install "$build" --prefix "$scratch/first" >/dev/null
mv "$scratch/first" "$prefix"  # nothing may know where it was put at first
said=$("$prefix/bin/trochoid" --version)
echo "installed program: $said"
[ "$said" = "$version" ]

# project NAME [CMAKE OPTION...]: build and run it
project() {
  cmake -G Ninja -S "$here/$1" -B "$scratch/build" --fresh -DCMAKE_PREFIX_PATH="$prefix" \
    -DVERSION="${version%.*}" "${@:2}"
  cmake --build "$scratch/build"
  "$scratch/build/$1"
}
strict="-Wall -Wextra -Werror"
project consumer -DCMAKE_CXX_FLAGS="$strict"
# In C nothing else may be looked for, nor the C++ library linked.
absent=$(printf -- '-DCMAKE_DISABLE_FIND_PACKAGE_%s=ON ' fmt hwy tomlplusplus nlohmann_json)
for components in "" controller; do
  project c_consumer -DCMAKE_C_FLAGS="$strict -std=c99" -DCOMPONENTS="$components" $absent
  if ldd "$scratch/build/c_consumer" | grep -E 'stdc|fmt|hwy|toml'; then
    echo "a project in C links more than C"
    exit 1
  fi
done

PKG_CONFIG_PATH=$(dirname "$(find "$prefix" -name trochoid.pc)")
export PKG_CONFIG_PATH
[ "$(pkg-config --modversion trochoid)" = "$version" ]
flags=$(pkg-config --libs trochoid-controller)
for part in fmt hwy toml stdc; do
  [[ $flags != *$part* ]] || { echo "the controller brings $part: $flags"; exit 1; }
done
[[ " $flags " == *" -lm "* ]]
cc -std=c99 $strict "$here/c_consumer/main.c" -o "$scratch/by_pkg_config_c" \
  $(pkg-config --cflags --libs trochoid-controller)
"$scratch/by_pkg_config_c"
c++ -std=c++20 $strict "$here/consumer/main.cpp" -o "$scratch/by_pkg_config" \
  $(pkg-config --cflags --libs trochoid)
"$scratch/by_pkg_config"

# What is installed needs nothing that is not; what is internal is not there. That each
# header compiles by itself is seen in the build.
(cd "$prefix/include" && find trochoid -name '*.h') >"$scratch/headers"
sed 's/.*/#include <&>/' "$scratch/headers" >"$scratch/all_headers.cpp"
c++ -std=c++20 -fsyntax-only $strict -I"$prefix/include" "$scratch/all_headers.cpp"
for internal in numerics/dense.h cases/schema.h dynamics/stepper.h report/page.h; do
  [ -f "$here/../../../src/trochoid/$internal" ]
  ! grep -qx "trochoid/$internal" "$scratch/headers" || { echo "$internal is installed"; exit 1; }
done

# What the page of the headers names is there.
grep -oE '`[a-z_/]+\.h`' "$here/../../../docs/cpp.md" | tr -d '`' | while read -r header; do
  grep -qx "trochoid/$header" "$scratch/headers" || { echo "$header is not installed"; exit 1; }
done

# The examples are projects of a stranger, too.
cmake -G Ninja -S "$here/../../../examples/cpp" -B "$scratch/examples" -DCMAKE_PREFIX_PATH="$prefix"
cmake --build "$scratch/examples"
for example in calibrate correct dynamics identify; do "$scratch/examples/example_$example"; done

# The installed files must point neither to where they were built nor to where they were.
top=$(cd -- "$here/../../.." && pwd)
if grep -rlF -e "$top" -e "$scratch/first" "$prefix" --include='*.cmake' --include='*.h' \
    --include='*.pc'; then
  echo "installed files name the source folder $top or the first prefix"
  exit 1
fi
