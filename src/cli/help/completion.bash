# bash completion for stipple: asks the program.
_stipple() {
    local i word words=() current=${COMP_WORDS[COMP_CWORD]#[\'\"]}
    for ((i = 1; i <= COMP_CWORD; i++)); do
        word=${COMP_WORDS[i]#[\'\"]}
        ((i < COMP_CWORD)) && word=${word%[\'\"]}
        # bash splits --option=value and unit:option=value at = and :
        if ((${#words[@]})) && [[ $word == [:=]* || ${COMP_WORDS[i - 1]} == *[:=] ]]; then
            words[-1]+=$word
        else
            words+=("$word")
        fi
    done
    [[ $current == [:=] ]] && current=
    mapfile -t COMPREPLY < <("${COMP_WORDS[0]/#\~/$HOME}" complete "${words[@]}" 2>/dev/null)
    COMPREPLY=("${COMPREPLY[@]%%$'\t'*}")
    if [[ ${COMPREPLY[0]} == @files ]]; then
        compopt -o filenames 2>/dev/null
        mapfile -t COMPREPLY < <(compgen -f -- "$current")
    else
        [[ ${COMPREPLY[0]} == *= ]] && compopt -o nospace 2>/dev/null
        COMPREPLY=("${COMPREPLY[@]#"${words[-1]%"$current"}"}")
    fi
}

complete -F _stipple stipple
