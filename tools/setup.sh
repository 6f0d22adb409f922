# Shared by ./run and ./test: what they need, and how it gets here. Sourced, not run.
#
# Everything may be interrupted anywhere: a stamp is written last, after what it vouches
# for, and every step repairs or repeats what an earlier attempt left half done.

root=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.." && pwd)
build=$root/build/release
log=$root/build/setup.log
export PATH=$PATH:/usr/sbin:/sbin

# Libraries by Debian package; the comment says what for.
libraries=(
  libeigen3-dev        # linear algebra
  libboost-dev         # Boost.Math: Student's t, quadrature, roots
  libfmt-dev           # number formatting
  libhwy-dev           # vectors of whatever width the machine has
  libtomlplusplus-dev  # case files
  nlohmann-json3-dev   # summary.json
  libcli11-dev         # command line
  zlib1g-dev           # packed records of MATLAB
  libhdf5-dev          # records in HDF5, those of MATLAB 7.3 among them
)
# Programs as command=package, so that one from another source is kept.
programs=(g++=g++ cmake=cmake ninja=ninja-build git=git pkg-config=pkg-config)
report_programs=(node=nodejs npm=npm)
python_libraries=(pybind11-dev libpython3-dev python3-numpy)
test_libraries=(libgtest-dev libbenchmark-dev libmatio-dev python3-scipy "${python_libraries[@]}")
# Of ./run packages.
package_programs=(dpkg-shlibdeps=dpkg-dev file=file xz=xz-utils)
# Of the documentation as a site (./run docs).
site_libraries=(python3-sphinx furo python3-myst-parser python3-breathe doxygen libjs-katex)
# Of the page that runs in a browser (./run web).
web_programs=(emcc=emscripten)
# Of the program for Windows (./run windows), and what runs it in the tests.
windows_programs=(x86_64-w64-mingw32-g++-posix=g++-mingw-w64-x86-64-posix wine=wine makensis=nsis)
windows_libraries=(libz-mingw-w64-dev wine64)
# Of the functions for MATLAB (./test --octave).
octave_programs=(octave-cli=octave)
# What the tests can do without: where it is missing, theirs are skipped.
optional_test_libraries=(linuxcnc-uspace linuxcnc-uspace-dev make valgrind
  mypy python3-pandas python3-matplotlib python3-pip python3-setuptools python3-wheel python3-venv
  python3-distributed python3-mpi4py openmpi-bin python3-jsonschema
  man-db zsh fish dpkg-dev file
  "${site_libraries[@]}")
test_programs=(clang-format=clang-format chromium-headless-shell=chromium-headless-shell ctags=universal-ctags)

# One argument, one line.
say() { printf '%s\n' "$@" >&2; }
stop() { say "$@"; exit 3; }

# The packages of "$@" (names, or command=package) that this machine lacks.
missing_packages() {
  local item names=()
  for item in "$@"; do
    case $item in
      *=*) command -v "${item%%=*}" >/dev/null || printf '%s\n' "${item#*=}" ;;
      *) names+=("$item") ;;
    esac
  done
  local installed
  installed=" $(dpkg-query -W -f '${db:Status-Status}=${Package} ' "${names[@]}" 2>/dev/null)"
  for item in "${names[@]}"; do
    [[ $installed == *" installed=$item "* ]] || printf '%s\n' "$item"
  done
}

as_root() {
  if [ "$(id -u)" = 0 ]; then
    "$@"
  else
    sudo -- "$@"
  fi
}

apt_get() {
  as_root env DEBIAN_FRONTEND=noninteractive apt-get -y -q \
    -o DPkg::Lock::Timeout=600 -o Acquire::Retries=3 \
    -o Dpkg::Options::=--force-confdef -o Dpkg::Options::=--force-confold "$@" \
    </dev/null >>"$log" 2>&1
}

install_packages() {
  local wanted try
  mapfile -t wanted < <(missing_packages "$@")
  if [ ${#wanted[@]} = 0 ] && [ -z "$(dpkg --audit 2>/dev/null)" ]; then
    return
  fi
  if [ "$(id -u)" != 0 ] && ! command -v sudo >/dev/null; then
    stop "Some Debian packages are missing, and only root can install them. Please run as root:" \
      "  apt-get update && apt-get install --no-install-recommends ${wanted[*]}"
  fi
  say "Installing what is missing (once, a few minutes): ${wanted[*]}"
  for try in 1 2 3; do
    # An earlier attempt may have been interrupted between unpacking and configuring.
    as_root env DEBIAN_FRONTEND=noninteractive dpkg --configure -a </dev/null >>"$log" 2>&1
    apt_get --fix-broken install
    if compgen -G '/var/lib/apt/lists/*Packages*' >/dev/null || [ $try -gt 1 ]; then
      apt_get install --no-install-recommends "${wanted[@]}" && return
    fi
    # No package lists yet, or old ones.
    apt_get update
  done
  tail -n 15 "$log" >&2
  stop "Installing the packages did not work; above is the end of $log." \
    "If the network was the reason, simply start the same command again."
}

# Packages that not every distribution has.
install_optional() {
  local wanted
  mapfile -t wanted < <(missing_packages "$@")
  [ ${#wanted[@]} = 0 ] && return
  say "Installing for some of the tests: ${wanted[*]}"
  apt_get install --no-install-recommends "${wanted[@]}" ||
    { apt_get update && apt_get install --no-install-recommends "${wanted[@]}"; } ||
    say "That did not work; the tests that need it are skipped."
}

# What node_modules must hold for "$1" (test, or what ./run makes): the lock file's packages.
have_node_modules() {
  local stamp=$root/node_modules/.complete
  [ ! -f "$root/package-lock.json" ] && return
  [ "$stamp" -nt "$root/package-lock.json" ] && { [ "$1" != test ] || [ "$(<"$stamp")" = test ]; }
}

install_node_modules() {
  have_node_modules "$1" && return
  local options=(--no-audit --no-fund --no-progress --ignore-scripts)
  [ "$1" = test ] || options+=(--omit=dev)
  say "Fetching the plot libraries of the report (npm)"
  if ! (cd "$root" && rm -rf node_modules && npm ci "${options[@]}") </dev/null >>"$log" 2>&1; then
    tail -n 15 "$log" >&2
    stop "npm did not get the plot libraries; above is the end of $log." \
      "If the network was the reason, simply start the same command again."
  fi
  printf '%s' "$1" >"$root/node_modules/.complete"
}

# setup run|python|docs|packages|web|windows|octave|test: install what it needs, unless its stamp says that this was done.
setup() {
  local stamp=$root/build/.setup-$1
  if [ "$stamp" -nt "$root/tools/setup.sh" ] && have_node_modules "$1"; then
    return
  fi
  local needs=("${libraries[@]}" "${programs[@]}")
  [ -f "$root/package-lock.json" ] && needs+=("${report_programs[@]}")
  [ "$1" = python ] && needs+=("${python_libraries[@]}")
  [ "$1" = packages ] && needs+=("${python_libraries[@]}" "${package_programs[@]}")
  [ "$1" = docs ] && needs+=("${python_libraries[@]}" "${site_libraries[@]}")
  [ "$1" = web ] && needs+=("${web_programs[@]}")
  [ "$1" = windows ] && needs+=("${windows_programs[@]}" "${windows_libraries[@]}")
  [ "$1" = octave ] && needs+=("${octave_programs[@]}")
  [ "$1" = test ] && needs+=("${test_libraries[@]}")
  if ! command -v dpkg-query >/dev/null; then
    stop "This is not a Debian system. Please install what tools/setup.sh lists, then:" \
      "  npm ci --omit=dev && cmake --preset release && cmake --build --preset release"
  fi
  install_packages "${needs[@]}"
  install_node_modules "$1"
  : >"$stamp"
}

# What running the tests needs and building most of them does not.
setup_for_running() {
  install_packages "${test_programs[@]}"
  install_optional "${optional_test_libraries[@]}"
  : >"$root/build/.setup-running"
}
is_set_up_for_running() { [ "$root/build/.setup-running" -nt "$root/tools/setup.sh" ]; }

# configure [CMAKE OPTION...]: once; afterwards ninja sees by itself what changed. Without
# options any earlier choice stands.
configure() {
  local stamp=$build/.configured wanted="$root $*" how=--fresh
  if [ -f "$stamp" ]; then
    local had
    had=$(<"$stamp")
    [ "$had" = "$wanted" ] && return
    [ $# = 0 ] && [[ $had == "$root "* ]] && return
    if [[ $had == "$root "* ]]; then  # --fresh would take away what is compiled, too
      how=
      rm -f "$build/CMakeCache.txt"
    fi
  fi
  say "Configuring the build"
  rm -f "$stamp"
  if ! (cd "$root" && cmake $how --preset release "$@") </dev/null >>"$log" 2>&1; then
    tail -n 25 "$log" >&2
    stop "CMake did not succeed; above is the end of $log." \
      "A fresh start may help: rm -rf '$root/build'"
  fi
  printf '%s' "$wanted" >"$stamp"
}

# compile TARGET...: says nothing when there is nothing to do.
compile() {
  local line announced=no
  ninja -C "$build" "$@" </dev/null 2>&1 | while IFS= read -r line; do
    case $line in
      \[*\]' '*Building* | \[*\]' '*Linking* | \[*\]' '*Re-running*)
        [ $announced = yes ] || say "Building (a few minutes the first time)"
        announced=yes
        [ -t 2 ] && printf '\r\033[K%s' "${line:0:79}" >&2
        ;;
      \[*\]' '* | 'ninja: no work'* | 'ninja: Entering'* | '-- '*) ;;
      *) say "$line" ;;
    esac
  done
  local status=${PIPESTATUS[0]}
  [ -t 2 ] && printf '\r\033[K' >&2
  [ "$status" = 0 ] || stop "The build did not succeed; the reason is above."
}

# The Python that the module is built for: Debian's, unless -DTROCHOID_PYTHON chose another.
chosen_python() {
  sed -n 's/^TROCHOID_PYTHON:[A-Z]*=//p' "$build/CMakeCache.txt"
}

# The build may be older than the packages that the module needs: then it looks once more.
compile_python() {
  if ! ninja -C "$build" -t query trochoid_python >/dev/null 2>&1; then
    cmake -DTROCHOID_BUILD_PYTHON=ON "$build" </dev/null >>"$log" 2>&1
    ninja -C "$build" -t query trochoid_python >/dev/null 2>&1 ||
      stop "CMake does not find what the Python module needs; see $log."
  fi
  compile trochoid_python
}

# compile_elsewhere FOLDER WHAT TARGET COMMAND...: for another system, whatever else was
# built; the command is that of CMake.
compile_elsewhere() {
  local folder=$1 what=$2 target=$3
  shift 3
  if [ ! -f "$folder/build.ninja" ]; then
    say "Configuring $what"
    (cd "$root" && "$@" --fresh -B "$folder" -G Ninja -DCMAKE_BUILD_TYPE=Release \
      -DTROCHOID_BUILD_TESTS=OFF -DTROCHOID_BUILD_PYTHON=OFF -DTROCHOID_DEVELOPER=OFF) </dev/null >>"$log" 2>&1 ||
      { rm -f "$folder/build.ninja"; tail -n 25 "$log" >&2; stop "CMake did not succeed; above is the end of $log."; }
  fi
  build=$folder compile "$target"
}

# After more was installed: CMake finds what it had not found.
look_again() {
  cmake "$build" </dev/null >>"$log" 2>&1 ||
    { tail -n 25 "$log" >&2; stop "CMake did not succeed; above is the end of $log."; }
}

# Nothing: Octave runs the functions as they are.
compile_octave() { look_again; }

# The page that runs in a browser.
compile_web() {
  compile_elsewhere "$root/build/web" "the page" trochoid_web emcmake cmake \
    -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON
}

# trochoid.exe.
compile_windows() {
  compile_elsewhere "$root/build/windows" "the program for Windows" trochoid_cli cmake \
    --toolchain "$root/cmake/windows/toolchain.cmake"
}

# pack FOLDER_OF_BUILD KIND...: packages of these kinds (of CPack), instead of older ones.
pack() {
  local from=$1 kind packages=$root/build/packages
  local -A ending=([DEB]=deb [TXZ]=tar.xz [ZIP]=zip [NSIS]=exe)
  shift
  mkdir -p "$packages"
  for kind in "$@"; do
    rm -f "$packages"/*."${ending[$kind]}"
    if ! cpack -G "$kind" --config "$from/CPackConfig.cmake" -B "$packages" </dev/null >>"$log" 2>&1; then
      tail -n 15 "$log" >&2
      stop "CPack did not succeed; above is the end of $log."
    fi
  done
  rm -rf "$packages/_CPack_Packages"
  (cd "$packages" && find . -maxdepth 1 -type f ! -name SHA256SUMS -printf '%f\0' | sort -z | xargs -0 sha256sum -- >SHA256SUMS)
}

# One at a time in one clone; the lock goes when the program ends, however it ends.
take_lock() {
  mkdir -p "$root/build" 2>/dev/null
  if ! { exec 9>"$root/build/.lock"; } 2>/dev/null; then
    stop "$root/build cannot be written (made by another user?)." \
      "This helps: sudo chown -R \"\$USER\" '$root/build' '$root/node_modules'"
  fi
  flock -n 9 || { say "Waiting for another ./run or ./test in this folder"; flock 9; }
}
release_lock() { exec 9>&-; }
