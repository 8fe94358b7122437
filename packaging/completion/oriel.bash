# SPDX-License-Identifier: Apache-2.0
# Completion of oriel for bash. Commands, options and shaders are asked of the program itself, so
# that they are those of the version that is installed.

_oriel_commands() {
  "$1" --help | sed -n '/^Subcommands:/,$s/^  \([a-z][a-z-]*\) .*/\1/p'
}

_oriel_options() {
  if [[ $2 == ray ]]; then
    "$1" ray -help | sed -n 's/^  \(-[A-Za-z_0-9]*\).*/\1/p'
  else
    "$1" "$2" --help | sed -n 's/^  \(-[^ {=]*\).*/\1/p' | tr ',' '\n'
  fi
}

_oriel_shaders() { "$1" shaders | sed -n 's/^  \([A-Za-z_0-9]*\) .*/\1/p'; }

# What may follow an option; exit code 1: files.
_oriel_values() {
  case $2 in
    --gi) printf '%s\n' path fg photons fg+photons scene ;;
    --view) printf '%s\n' agx neutral ;;
    --mi) printf '%s\n' base architectural physics oriel ;;
    --templates) "$1" shaders --templates | sed -n 's/^template_\([a-z_]*\)$/\1/p' ;;
    *) return 1 ;;
  esac
}

# The endings of the files that a command reads.
_oriel_endings() {
  case $1 in
    render | ray | check | measure | explain) echo 'mi|mi.gz' ;;
    tonemap | denoise | recombine | falsecolor) echo 'exr' ;;
    diff) echo 'exr|hdr|png|jpg|tif' ;;
    studio) echo 'mi|mi.gz|glb|gltf|obj|fbx|dae|ifc' ;;
    quick | convert) echo 'glb|gltf|obj|fbx|dae|ifc|mi' ;;
    profile) echo 'ies|IES|ldt|LDT' ;;
    shader-build) echo 'c|cpp|cc|cxx' ;;
    *) echo '.*' ;;
  esac
}

_oriel_files() {
  local file
  compgen -d -- "$2"
  compgen -f -- "$2" | while read -r file; do
    [[ -f $file && $file =~ \.($1)$ ]] && printf '%s\n' "$file"
  done
}

_oriel() {
  local program=$1 word=$2 before=$3 command=${COMP_WORDS[1]} words IFS=$'\n'
  if ((COMP_CWORD == 1)); then
    words=$(_oriel_commands "$program" && printf '%s\n' --help --version)
  elif words=$(_oriel_values "$program" "$before"); then
    :
  elif [[ $word == -* ]]; then
    words=$(_oriel_options "$program" "$command")
  elif [[ $command == shaders ]]; then
    words=$(_oriel_shaders "$program")
  else
    [[ $before == -[oI] || $before == --output || $before == --include ]] && command=any
    words=$(_oriel_files "$(_oriel_endings "$command")" "$word")
    compopt -o filenames 2>/dev/null
  fi
  COMPREPLY=($(compgen -W "$words" -- "$word"))
}

complete -F _oriel oriel
