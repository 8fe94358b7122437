# shellcheck shell=bash
# SPDX-License-Identifier: Apache-2.0
# Checks of any installation of Oriel. Sourced by the tests in this folder; $root is a folder for
# temporary files.
# shellcheck disable=SC2154

fail() { echo "FAILED: $*" >&2; exit 1; }

# check_files PREFIX: all files of an installation.
check_files() {
  local file
  for file in bin/oriel lib/oriel/liboriel_image_files.so share/oriel/templates.mi \
      share/oriel/mi/{base,architectural,physics,oriel}.mi include/oriel/sdk/shader.h \
      lib/cmake/OrielShaders/OrielShadersConfig.cmake lib/pkgconfig/oriel-shaders.pc \
      lib/liboriel.so include/oriel/oriel.h share/oriel/examples/embed/relight.c share/oriel/studio/index.html \
      share/oriel/examples/scenes/{nine-tiles,room}.mi; do
    [[ -f $1/$file ]] || fail "no $file"
  done
}

# run PREFIX ARGUMENT...: runs the installed program without the user's environment.
run() {
  local prefix=$1
  shift
  (cd "$root" && env -i PATH=/usr/bin:/bin HOME="$root" "$prefix/bin/oriel" "$@") ||
    fail "oriel $*"
}

# check_program PREFIX: the program renders, and finds data, headers and the image module in the installation.
check_program() {
  local prefix=$1 data
  [[ $(run "$prefix" --version) =~ ^oriel\ [0-9] ]] || fail "--version"
  run "$prefix" render "$prefix/share/oriel/examples/scenes/nine-tiles.mi" -o "$root/tiles.exr" \
    -o "$root/tiles.jpg" --size 48x48 --samples 4 --quiet 2>"$root/said" || cat "$root/said"
  [[ -s $root/tiles.exr && -s $root/tiles.jpg ]] || fail "no picture"
  run "$prefix" shaders --mi base >"$root/base.mi"
  cmp -s "$root/base.mi" "$prefix/share/oriel/mi/base.mi" || fail "base.mi"
  # Templates name textures by absolute paths in the installation.
  data=$(run "$prefix" shaders --templates stone)
  [[ $data == *"$prefix/share/oriel/textures/stone.exr"* ]] || fail "templates of another folder"
}

# check_shader_build PREFIX: an example shader in C++ builds with the installed headers.
check_shader_build() {
  run "$1" shader-build "$1/share/oriel/examples/shaders/material" -o "$root/example.so" \
    >"$root/said" 2>&1 || { cat "$root/said"; fail "shader-build"; }
  [[ -s $root/example.so ]] || fail "no library of shaders"
}

# check_embedding PREFIX: the C example builds with the installed header and library, and sees an edit.
check_embedding() {
  local prefix=$1 compiler
  compiler=$(command -v cc gcc clang | head -1) || { echo "no C compiler: liboriel is not tried"; return; }
  sed 's/resolution [0-9]* [0-9]*/resolution 24 24/' "$prefix/share/oriel/examples/scenes/nine-tiles.mi" \
    >"$root/embedded.mi"
  "$compiler" -I "$prefix/include" "$prefix/share/oriel/examples/embed/relight.c" -o "$root/relight" \
    -L "$prefix/lib" -loriel -Wl,-rpath,"$prefix/lib" -Wl,--allow-shlib-undefined || fail "relight.c"
  (cd "$root" && env -i HOME="$root" ./relight embedded.mi "white_matte.diffuse=.9 .1 .1" >"$root/said") ||
    fail "relight"
  [[ $(sed 's/^[a-z]*: //' "$root/said" | sort -u | wc -l) == 2 ]] || fail "the edit has no effect"
}

# check_bundle PREFIX: every library of the program and its module is in the installation, except
# glibc's, and each has its licence there.
check_bundle() {
  local folder=$1/lib/oriel/libraries doc=$1/share/doc/oriel/libraries name path
  # The RPATH of the program also finds the libraries of the module, so both are in one process.
  (cd "$1/lib/oriel" && env -i LD_TRACE_LOADED_OBJECTS=1 LD_PRELOAD=./liboriel_image_files.so \
    "$1/bin/oriel") >"$root/needed" || fail "the libraries cannot be listed"
  ! grep 'not found' "$root/needed" || fail "libraries are missing"
  while read -r path; do
    [[ $(realpath "$path") == "$folder"/* ||
      $path =~ /(libc|libm|libdl|libpthread|librt|libresolv|libutil|libmvec|libanl)\.so\.[0-9]+$ ]] ||
      fail "a library of the system is used: $path"
  done < <(sed -n 's/^.* => \(.*\) (0x[0-9a-f]*)$/\1/p' "$root/needed")
  [[ $(find "$folder" -name 'lib*.so*' | wc -l) -gt 100 ]] || fail "too few libraries"
  for path in "$folder"/*; do
    name=$(basename "$path")
    name=$(awk -v name="$name" '$2 == name { print $4 }' "$doc/LIBRARIES.md")
    [[ -n $name && -s $doc/$name.copyright ]] || fail "no licence of $path"
  done
}
