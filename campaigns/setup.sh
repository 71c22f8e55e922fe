# shellcheck shell=bash
# campaigns/setup.sh: from a bare Debian machine to a configured build folder; sourced by campaigns/run and tests/run.
#
#   setup_packages NAME...        install what is missing; nothing missing: no network, well under a second
#   setup_build FOLDER OPTION...  cmake with these options (none: as it was configured before), then build
#   setup_say TEXT...             what is being done, on stderr: stdout is for results
#
# Sets ROOT (the checkout) and CORES. Callers run under `set -euo pipefail`.

ROOT=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
CORES=$(nproc)
readonly ROOT CORES
export CMAKE_BUILD_PARALLEL_LEVEL=$CORES

# What building and running take; tests/run adds the test library.
# shellcheck disable=SC2034  # used by the two callers
readonly BUILD_PACKAGES=(gcc libc6-dev cmake ninja-build pkg-config openmpi-bin libopenmpi-dev libhdf5-dev
    libgsl-dev libyaml-dev libudunits2-dev)
# shellcheck disable=SC2034
readonly FIGURE_PACKAGES=(python3 python3-h5py python3-numpy python3-matplotlib python3-yaml)

# Open MPI as root, in containers and on machines without ssh: allow root, do not insist on a core per rank, do not pin
# (two jobs would share a core while another idles), start ranks by fork, copy through shared memory only.
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
export OMPI_MCA_rmaps_base_oversubscribe=1 OMPI_MCA_hwloc_base_binding_policy=none
export OMPI_MCA_plm=isolated OMPI_MCA_btl_vader_single_copy_mechanism=none

# A closed stdin makes the next opened file stdin; no command here asks anything.
exec </dev/null

setup_say() { printf '%s: %s\n' "${0##*/}" "$*" >&2; }

setup_missing() {
    local installed package
    installed=$(dpkg-query -W -f '${Package} ${db:Status-Status}\n' "$@" 2>/dev/null || true)
    for package in "$@"; do
        grep -qxF "$package installed" <<<"$installed" || printf '%s\n' "$package"
    done
}

setup_packages() {
    local missing as_root=()
    if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
        setup_say "no dpkg-query or apt-get, so no Debian: going on with what is there; needed (Debian's names): $*"
        return
    fi
    mapfile -t missing < <(setup_missing "$@")
    if ((${#missing[@]} == 0)); then return; fi
    if ((EUID != 0)); then
        if ! command -v sudo >/dev/null; then
            setup_say "packages are missing, and this user is neither root nor has sudo. Ask somebody who is to run"
            setup_say "    apt-get install --no-install-recommends ${missing[*]}"
            exit 1
        fi
        as_root=(sudo)
    fi
    setup_say "installing ${missing[*]}"
    local apt=("${as_root[@]}" env DEBIAN_FRONTEND=noninteractive
        apt-get -qq -o DPkg::Lock::Timeout=300 -o Dpkg::Use-Pty=0)
    "${apt[@]}" update >&2 || setup_say "apt-get update failed; trying with the package lists of this machine"
    if ! "${apt[@]}" -y install --no-install-recommends "${missing[@]}" >&2; then
        setup_say "apt-get could not install ${missing[*]}; its message is above"
        exit 1
    fi
}

# Quiet when all is well; the whole output when a step fails.
setup_quietly() {
    local log status=0
    log=$(mktemp)
    "$@" >"$log" 2>&1 || status=$?
    if ((status != 0)); then cat "$log" >&2; fi
    rm -f "$log"
    return "$status"
}

setup_build() {
    local folder=$1
    shift
    if (($# > 0)) || [[ ! -e $folder/build.ninja ]]; then
        setup_say "configuring $folder"
        local generator=()
        [[ -e $folder/CMakeCache.txt ]] || generator=(-G Ninja)
        setup_quietly cmake -S "$ROOT" -B "$folder" "${generator[@]}" "$@"
    fi
    setup_say "building on $CORES cores"
    setup_quietly cmake --build "$folder" "${SETUP_TARGET[@]/#/--target=}"
}

# The first Python that has what the figures need: Debian's own before a pyenv or conda one earlier in PATH.
setup_find_python() {
    local python
    for python in /usr/bin/python3 python3; do
        if "$python" -c 'import h5py, matplotlib, numpy' >/dev/null 2>&1; then
            command -v "$python"
            return
        fi
    done
    return 1
}
