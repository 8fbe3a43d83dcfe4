# Completion of scree's command line for bash. Installed as share/bash-completion/completions/scree; by hand:
#   source tools/completion/scree.bash

_scree_keys() {  # the keys of a scenario, section.key, as the program's reference page lists them
    "$1" schema --reference 2>/dev/null </dev/null | awk '
        /^## /      { section = $0 == "## The first level" ? "" : $2 "." }
        /^### [a-z]/ { section = $2 "." }
        /^[|] `/    { split($0, part, "`"); print section part[2] }' | sort -u
}

_scree() {
    local cur prev words cword command="" i
    if declare -F _init_completion >/dev/null; then
        _init_completion -n = || return
    else
        words=("${COMP_WORDS[@]}")
        cword=$COMP_CWORD
        cur=${words[cword]}
        prev=${words[cword - 1]}
    fi
    local commands="run check info compare explain schema"
    COMPREPLY=()
    for ((i = 1; i < cword; i++)); do
        if [[ ${words[i]} != -* ]]; then
            command=${words[i]}
            break
        fi
    done
    if [[ -z $command ]]; then
        mapfile -t COMPREPLY < <(compgen -W "$commands help --help --version" -- "$cur")
        return
    fi

    case $prev in
        --out | -o)
            mapfile -t COMPREPLY < <(compgen -d -- "$cur")
            compopt -o filenames 2>/dev/null
            return
            ;;
        --walltime | --tolerance | --ranks)
            return
            ;;
        --set)
            # Keys of lists and of named sections need an index or a name in between: those are left to the user.
            mapfile -t COMPREPLY < <(compgen -S = -W "$(_scree_keys "${words[0]}" |
                grep -E '^((time|solver|correction|output)[.])?[a-z_]+$')" -- "$cur")
            compopt -o nospace 2>/dev/null
            return
            ;;
    esac

    local options="--help" files=""
    case $command in
        run)
            options+=" --out --set --resume --force --walltime --quiet --verbose"
            files=yaml
            ;;
        check)
            options+=" --set --ranks"
            files=yaml
            ;;
        compare)
            options+=" --tolerance"
            files=any
            ;;
        info) files=any ;;
        explain)
            if [[ $cur != -* ]]; then
                mapfile -t COMPREPLY < <(compgen -W "$(_scree_keys "${words[0]}")" -- "$cur")
                return
            fi
            ;;
        schema) options+=" --reference" ;;
    esac
    if [[ $cur == -* ]]; then
        mapfile -t COMPREPLY < <(compgen -W "$options" -- "$cur")
    elif [[ $files == yaml ]]; then
        mapfile -t COMPREPLY < <(
            compgen -f -X '!*.yaml' -- "$cur"
            compgen -f -X '!*.yml' -- "$cur"
            compgen -d -- "$cur"
        )
        compopt -o filenames 2>/dev/null
    elif [[ $files == any ]]; then
        mapfile -t COMPREPLY < <(compgen -f -- "$cur")
        compopt -o filenames 2>/dev/null
    fi
}
complete -F _scree scree
