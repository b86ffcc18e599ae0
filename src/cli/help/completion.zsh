#compdef stipple
# zsh completion for stipple: asks the program.
_stipple() {
    local -a found
    found=("${(@f)$($words[1] complete "${(@Q)words[2,CURRENT]}" 2>/dev/null)}")
    if [[ $found[1] == @files ]]; then
        compset -P '*='
        _files
    elif [[ -n $found[1] ]]; then
        local -a suffix
        [[ ${found[1]%%$'\t'*} == *= ]] && suffix=(-S '')
        found=("${(@)found//:/\\:}")
        found=("${(@)found//$'\t'/:}")
        _describe stipple found $suffix
    fi
}

_stipple "$@"
