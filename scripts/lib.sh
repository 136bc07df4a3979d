# shellcheck shell=bash disable=SC2034
# Parts that the scripts of this folder share. Sourced, not run.

project=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

# What the build needs, by Debian's names.
build_packages=(
    g++ cmake ninja-build
    libvulkan-dev mesa-vulkan-drivers
    glslang-dev glslang-tools spirv-tools
    libglm-dev nlohmann-json3-dev libcli11-dev libtinyobjloader-dev libtinyexr-dev libstb-dev libglfw3-dev libgl-dev
    doctest-dev libembree-dev
)

# What the tests need on top.
test_packages=(vulkan-validationlayers clang clang-format clang-tidy xvfb xauth)

die() {
    printf '%s: %s\n' "${0##*/}" "$*" >&2
    exit 1
}

# as_root COMMAND...: by sudo where need be, which asks for a password only at a terminal.
as_root() {
    if [[ $EUID -eq 0 ]]; then
        "$@"
    elif ! command -v sudo >/dev/null; then
        die "this needs root and there is no sudo; run as root: $*"
    elif [[ -t 0 ]]; then
        sudo "$@"
    else
        sudo -n "$@"
    fi
}

# step TITLE COMMAND...: runs the command and says how long it took.
step() {
    local title=$1 start=$EPOCHREALTIME
    shift
    printf '== %s\n' "$title"
    "$@"
    # EPOCHREALTIME has six decimals: without its point it counts microseconds.
    printf '== %s: %d ms\n' "$title" $(((${EPOCHREALTIME/[.,]/} - ${start/[.,]/}) / 1000))
}

# The packages of the arguments that are not installed.
missing_packages() {
    local package
    for package in "$@"; do
        [[ $(dpkg-query --show --showformat='${db:Status-Status}' "$package" 2>/dev/null) == installed ]] || printf '%s\n' "$package"
    done
}

# install_packages PACKAGE...: those that are missing; no network and no root when none is.
install_packages() {
    if ! command -v apt-get >/dev/null || ! command -v dpkg-query >/dev/null; then
        die "this is no Debian: install what these packages of Debian 12 hold, then run again with --no-install: $*"
    fi
    local missing
    mapfile -t missing < <(missing_packages "$@")
    [[ ${#missing[@]} -gt 0 ]] || return 0
    printf 'Installing %s\n' "${missing[*]}"
    as_root apt-get -qq update || die "apt-get update failed"
    as_root env DEBIAN_FRONTEND=noninteractive apt-get -qq -y --no-install-recommends install "${missing[@]}" </dev/null ||
        die "apt-get could not install: ${missing[*]} (they are packages of Debian 12)"
}
