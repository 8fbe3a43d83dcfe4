# Functions shared by the scripts of this folder. Source it; do not run it.
# shellcheck shell=bash

SCREE_ROOT=$(cd -- "$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")/.." && pwd -P)
readonly SCREE_ROOT
# shellcheck disable=SC2034  # used by those who source this
readonly EXIT_USAGE=2
readonly EXIT_MISSING=69  # packages that are not there: "service unavailable" in sysexits.h

say() { printf '%s\n' "$*" >&2; }
heading() { printf '\n== %s\n' "$*" >&2; }
fail() {  # fail CODE MESSAGE...
    local code=$1
    shift
    say "error: $*"
    exit "$code"
}

# The names in packages.txt, without comments.
list_packages() {
    sed -e 's/#.*//' -e 's/[[:space:]]//g' -e '/^$/d' "$SCREE_ROOT/tools/packages.txt"
}

# Those of them that dpkg does not have installed.
missing_packages() {
    local wanted
    mapfile -t wanted < <(list_packages)
    comm -23 <(printf '%s\n' "${wanted[@]}" | sort -u) \
        <(dpkg-query --show --showformat '${Package} ${db:Status-Status}\n' "${wanted[@]}" 2>/dev/null |
            sed -n 's/ installed$//p' | sort -u)
}

# How to become root: prints nothing for root itself, "sudo" where that can work; fails otherwise. sudo may ask for a
# password only if somebody is there to type it.
root_prefix() {
    [ "$(id -u)" -eq 0 ] && return 0
    command -v sudo >/dev/null || return 1
    if sudo -n true 2>/dev/null || { [ -t 0 ] && [ -z "${CI:-}" ]; }; then
        echo sudo
    else
        return 1
    fi
}

apt_install() {  # apt_install PREFIX PACKAGE...
    local prefix=$1 attempt
    shift
    local apt=(env DEBIAN_FRONTEND=noninteractive apt-get -o DPkg::Lock::Timeout=300 -qq)
    [ -z "$prefix" ] || apt=("$prefix" "${apt[@]}")
    local install=(install --yes --no-install-recommends "$@")
    # The lists are fetched only if they are absent or too old to resolve the packages.
    "${apt[@]}" --simulate "${install[@]}" >/dev/null 2>&1 </dev/null || "${apt[@]}" update || true
    for attempt in 1 2; do
        if "${apt[@]}" "${install[@]}" </dev/null >&2; then
            return 0
        fi
        [ "$attempt" -eq 2 ] || { say "apt-get failed; once more with fresh lists"; "${apt[@]}" update || true; }
    done
    return 1
}

# Installs what is missing. Needs no rights and calls no apt if everything is there.
require_packages() {
    if ! command -v dpkg-query >/dev/null; then
        say "note: no dpkg here, so the packages in tools/packages.txt are taken to be installed by other means"
        return 0
    fi
    local missing prefix
    mapfile -t missing < <(missing_packages)
    [ "${#missing[@]}" -gt 0 ] || return 0
    heading "Installing ${#missing[@]} packages: ${missing[*]}"
    if ! prefix=$(root_prefix); then
        say "Root is needed for this, and sudo cannot be used here. Run, as root:"
        say "  apt-get update && apt-get install --yes --no-install-recommends ${missing[*]}"
        exit "$EXIT_MISSING"
    fi
    apt_install "$prefix" "${missing[@]}" || fail "$EXIT_MISSING" "apt-get could not install: ${missing[*]}"
    mapfile -t missing < <(missing_packages)
    [ "${#missing[@]}" -eq 0 ] || fail "$EXIT_MISSING" "still missing after apt-get: ${missing[*]}"
}

# Compilers at once: one a core, but no more than one for each GiB of memory that is free.
build_jobs() {
    local cores free
    cores=$(nproc)
    free=$(awk '/^MemAvailable:/ { print int($2 / 1048576) }' /proc/meminfo 2>/dev/null || true)
    [ -n "$free" ] || free=$cores
    [ "$free" -ge 1 ] || free=1
    echo $((cores < free ? cores : free))
}

# configure PRESET: makes build/PRESET unless it is there already; a build folder that came from another place with a
# copy of the sources is made anew.
configure() {
    local preset=$1 folder=$SCREE_ROOT/build/$1 log origin
    log=$folder/configure.log
    if [ -f "$folder/build.ninja" ]; then
        origin=$(sed -n 's/^CMAKE_HOME_DIRECTORY:INTERNAL=//p' "$folder/CMakeCache.txt")
        [ "$origin" = "$SCREE_ROOT" ] && return 0
    fi
    heading "Configuring build/$preset"
    mkdir -p "$folder"
    if ! (cd "$SCREE_ROOT" && cmake --fresh --preset "$preset") >"$log" 2>&1; then
        cat "$log" >&2
        fail 1 "configuring failed; the output above is also in build/$preset/configure.log"
    fi
    grep -E '^CMake Warning' -A 6 "$log" >&2 || true
}

# build PRESET [TARGET...]
build() {
    local preset=$1
    shift
    local targets=()
    [ $# -eq 0 ] || targets=(--target "$@")
    heading "Building build/$preset"
    cmake --build "$SCREE_ROOT/build/$preset" --parallel "$(build_jobs)" "${targets[@]}" >&2 ||
        fail 1 "building failed"
}
