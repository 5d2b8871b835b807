# What run.sh and test.sh share: Debian packages and the build. Sourced, with
# $root set to the source tree.

# fail MESSAGE: one sentence and the end.
fail()
{
  echo "$(basename "$0"): $1" >&2
  exit 1
}

# quietly LOG COMMAND...: shows the end of the output only if the command fails.
quietly()
{
  local log="$1"
  shift
  if ! "$@" >"$log" 2>&1; then
    tail -n 60 "$log" >&2
    fail "'$*' failed; the whole output is in $log."
  fi
}

# install_packages [PACKAGE...]: those of .ci/packages.txt, and these.
install_packages()
{
  local package missing=()
  while read -r package; do
    case "$package" in '' | '#'*) continue ;; esac
    dpkg-query -W -f='${Status}' "$package" 2>/dev/null |
      grep -q 'ok installed' || missing+=("$package")
  done < <(cat "$root/.ci/packages.txt" && printf '%s\n' "$@")
  [ ${#missing[@]} -eq 0 ] && return

  local as_root=()
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null ||
      fail "install these packages as root first: ${missing[*]}"
    as_root=(sudo)
  fi
  command -v apt-get >/dev/null ||
    fail "this is no Debian; install what corresponds to: ${missing[*]}"
  echo "Installing ${#missing[@]} Debian packages (some minutes) ..."
  local log
  log="$(mktemp)"
  quietly "$log" "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get -q update
  quietly "$log" "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get -q -y install --no-install-recommends "${missing[@]}"
  rm -f "$log"
}

# As many compilers at once as there are cores, and 1.5 GB for each.
build_jobs()
{
  local cores memory_jobs
  cores="$(nproc)"
  memory_jobs="$(awk '/^MemAvailable/ { print int($2 / 1500000) }' /proc/meminfo)"
  [ "${memory_jobs:-1}" -ge 1 ] || memory_jobs=1
  echo $((cores < memory_jobs ? cores : memory_jobs))
}

# build TARGET...: Release, in build/; nothing happens if all is up to date.
build()
{
  local build="$root/build" cache="$root/build/CMakeCache.txt"
  mkdir -p "$build"
  if [ -f "$cache" ] && ! grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$root" "$cache"; then
    rm -rf "$cache" "$build/CMakeFiles" # the tree was moved or copied
  fi
  if [ ! -f "$build/build.ninja" ] || [ ! -f "$cache" ] ||
    ! grep -q '^CMAKE_BUILD_TYPE:[A-Z]*=Release$' "$cache"; then
    quietly "$build/configure.log" cmake -G Ninja -S "$root" -B "$build" \
      -DCMAKE_BUILD_TYPE=Release
  fi
  [ -x "$build/morsel" ] || echo "Building (some minutes the first time) ..."
  quietly "$build/build.log" ninja -C "$build" -j "$(build_jobs)" "$@"
}

# build_preset NAME: all targets of a preset of CMakePresets.json, in build-NAME/.
build_preset()
{
  local build="$root/build-$1"
  mkdir -p "$build"
  (cd "$root" && quietly "$build/configure.log" cmake --preset "$1")
  echo "Building $build (long the first time) ..."
  quietly "$build/build.log" ninja -C "$build" -j "$(build_jobs)"
}
