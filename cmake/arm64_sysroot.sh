#!/bin/sh
# Makes a folder with the libraries for aarch64 that the program and its tests link with.
#
# They are Debian's own packages, but unpacked, not installed: libyaml-cpp-dev and libsimdjson-dev
# for two architectures cannot be installed beside each other, and the machine's apt stays as it is.
# Needs no root. A folder that was made from the same list of packages is kept.
#
#   cmake/arm64_sysroot.sh build/arm64-sysroot
set -eu

mkdir -p "$1"
sysroot=$(cd "$1" && pwd)
list=$(dirname "$0")/packages.txt

packages=$(awk '($1 == "program" || $1 == "test") && $2 ~ /^(lib|nlohmann)/ { print $2 }' "$list")
if [ "$(cat "$sysroot/packages" 2>/dev/null)" = "$packages" ]; then exit 0; fi

# An apt with a memory of its own, for which aarch64 is the machine and nothing is installed.
apt_state=$sysroot/apt
mkdir -p "$apt_state/lists/partial" "$apt_state/cache/archives/partial"
: >"$apt_state/status"
cat >"$apt_state/apt.conf" <<CONF
APT::Architecture "arm64";
APT::Architectures { "arm64"; };
APT::Install-Recommends "false";
APT::Sandbox::User "";
Dir::State "$apt_state";
Dir::State::status "$apt_state/status";
Dir::Cache "$apt_state/cache";
CONF
APT_CONFIG=$apt_state/apt.conf
export APT_CONFIG
apt-get update -qq
# shellcheck disable=SC2086
apt-get install -y -qq --download-only $packages >/dev/null

# The cross compiler brings the C and C++ libraries; ours must not get in their way.
for deb in "$apt_state"/cache/archives/*.deb; do
  case $(basename "$deb") in
    libc6* | libc-* | linux-libc-dev* | libgcc* | gcc-* | libstdc++*) ;;
    *) dpkg-deb -x "$deb" "$sysroot" ;;
  esac
done
rm -rf "$apt_state"
echo "$packages" >"$sysroot/packages"
