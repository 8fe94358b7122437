# SPDX-License-Identifier: Apache-2.0
# Completion of oriel for fish. Commands, options and shaders are asked of the program itself.

function __oriel_command
    set -l words (commandline -opc)
    test (count $words) -gt 1; and echo $words[2]
end

function __oriel_commands
    oriel --help | string replace -rf '^  ([a-z][a-z-]*) +(.*)' '$1\t$2'
    printf '%s\n' --help --version
end

function __oriel_options
    set -l command (__oriel_command)
    if test "$command" = ray
        oriel ray -help | string replace -rf '^  (-\w+).*' '$1'
    else
        oriel $command --help | string replace -rf '^  (-[^ {=]*).*' '$1' | string split ,
    end
end

function __oriel_shaders
    oriel shaders | string replace -rf '^  (\w+) +(.*)' '$1\t$2'
end

complete -c oriel -n 'test -z "(__oriel_command)"' -f -a '(__oriel_commands)'
complete -c oriel -n 'test "(__oriel_command)" = shaders' -f -a '(__oriel_shaders)'
complete -c oriel -n 'string match -q -- "-*" (commandline -ct)' -f -a '(__oriel_options)'
complete -c oriel -l gi -x -a 'path fg photons fg+photons scene'
complete -c oriel -l view -x -a 'agx neutral'
complete -c oriel -l mi -x -a 'base architectural physics oriel'
