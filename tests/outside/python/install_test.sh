#!/usr/bin/env bash
# Install the Python module to an empty place, move it, and import it; then by pip. Then pack it.
# Usage: install_test.sh BUILD_FOLDER SCRATCH_FOLDER PYTHON
set -euo pipefail
root=$(cd -- "$(dirname -- "$0")/../../.." && pwd)
build=$1 scratch=$2 python=$3
unset PYTHONPATH
say_peak='import sys, trochoid
assert trochoid.__file__.startswith(sys.argv[1]), trochoid.__file__
print(trochoid.simulate(sys.argv[2]).peak_xy_N)'

# peak FOLDER: import the module that lies there and use it
peak() { (cd / && PYTHONPATH=$1 "$python" -c "$say_peak" "$1" "$root/examples/ball/case.toml"); }

rm -rf "$scratch"
mkdir -p "$scratch"
cmake --install "$build" --component python --prefix "$scratch/first" >/dev/null
mv "$scratch/first" "$scratch/moved"
first=$(peak "$(dirname "$(find "$scratch/moved" -name trochoid -type d)")")

# pip takes what is built in build/release; building all of it anew takes too long here.
if [ "$build" != "$root/build/release" ] ||
  ! "$python" -c 'import setuptools, wheel, pip' 2>/dev/null; then  # setuptools not after pip
  echo "installed: $first; not tried with pip"
  exit
fi
(cd "$root" && "$python" -m pip install --quiet --no-build-isolation --no-index --no-deps \
  --disable-pip-version-check --target "$scratch/pip" . 2>&1) | grep -v "'root' user" || true
[ "$(peak "$scratch/pip")" = "$first" ]
[ -f "$scratch/pip/trochoid/py.typed" ]

# A source distribution has all that the module is built of, as far as CMake looks for it; and
# the libraries of the report, which npm would fetch.
(cd "$root" && "$python" -W ignore setup.py -q sdist --dist-dir "$scratch/sdist" 2>/dev/null)
tar xzf "$scratch"/sdist/trochoid-*.tar.gz -C "$scratch/sdist"
cmake -S "$scratch"/sdist/trochoid-*/ -B "$scratch/sdist/build" -DTROCHOID_BUILD_TESTS=OFF \
  -DTROCHOID_DEVELOPER=OFF -DTROCHOID_PYTHON="$python" -DNPM= >"$scratch/sdist/log" 2>&1 ||
  { cat "$scratch/sdist/log"; exit 1; }
echo "installed and by pip: $first"
