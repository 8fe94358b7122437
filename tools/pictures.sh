# shellcheck shell=bash
# SPDX-License-Identifier: Apache-2.0
# What the scripts share that make the pictures of docs/: their arguments, and rendering what is not
# there yet. Source it with the script's arguments, and the name of the folder in docs/images first.
# Sets root, oriel, work (linear files) and out.

root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
oriel="$root/build/release/bin/oriel"
out="$root/docs/images/$1"
shift
if [[ ${1:-} == --oriel ]]; then
  oriel="$2"
  shift 2
fi
if [[ $# -gt 0 ]]; then
  work="$1"
  mkdir -p "$work"
else
  work="$(mktemp -d)"
  trap 'rm -r -- "$work"' EXIT
fi
mkdir -p "$out"

# render NAME SCENE OPTIONS...: scenes/SCENE to NAME.exr with a layer "denoised".
render() {
  [[ -f $work/$1.exr ]] && return
  "$oriel" render "$root/scenes/$2" -o "$work/$1.exr" --denoise "${@:3}"
}

# picture NAME FROM OPTIONS...: NAME.jpg from FROM.exr.
picture() {
  "$oriel" tonemap "$work/$2.exr" --layer denoised -o "$out/$1.jpg" "${@:3}"
}
