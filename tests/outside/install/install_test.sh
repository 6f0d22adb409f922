#!/usr/bin/env bash
# Install to an empty place, then build and run a foreign project with find_package.
# Usage: install_test.sh BUILD_FOLDER SCRATCH_FOLDER VERSION
set -euo pipefail
here=$(cd -- "$(dirname -- "$0")" && pwd)
build=$1 scratch=$2

rm -rf "$scratch"
mkdir -p "$scratch"
cmake --install "$build" --prefix "$scratch/prefix" >/dev/null
version=$("$scratch/prefix/bin/trochoid" --version)
echo "installed program: $version"
[ "$version" = "$3" ]

cmake -G Ninja -S "$here/consumer" -B "$scratch/build" \
  -DCMAKE_PREFIX_PATH="$scratch/prefix" -DCMAKE_CXX_FLAGS="-Wall -Wextra -Werror"
cmake --build "$scratch/build"
"$scratch/build/consumer"

# The installed files must not point back to where they were built.
top=$(cd -- "$here/../../.." && pwd)
if grep -rlF -- "$top" "$scratch/prefix" --include='*.cmake' --include='*.h'; then
  echo "installed files name the source folder $top"
  exit 1
fi
