# Completes commands and options of touchstone, as its --help lists them.
_touchstone() {
  local cur prev words cword
  _init_completion || return
  local program=$1 help word values
  local -a path=()
  help=$("$program" --help 2>/dev/null) || return
  # commands_in: a command's row has two blanks before its name and two behind it.
  commands_in() { sed -n 's/^  \([a-z]\{1,\}\)  .*/\1/p' <<<"$1"; }
  for word in "${words[@]:1:cword-1}"; do
    if grep -qx -- "$word" <<<"$(commands_in "$help")"; then
      path+=("$word")
      help=$("$program" "${path[@]}" --help 2>/dev/null) || return
    fi
  done
  values=$(sed -n "s/^ *[^ ]*${prev//\//} [^ ]*:{\([^}]*\)}.*/\1/p" <<<"$help")
  if [[ $prev == --* && -n $values ]]; then
    COMPREPLY=($(compgen -W "${values//,/ }" -- "$cur"))
  elif [[ $cur == -* ]]; then
    COMPREPLY=($(compgen -W "$(_parse_help - <<<"$help")" -- "$cur"))
  else
    COMPREPLY=($(compgen -W "$(commands_in "$help")" -- "$cur"))
    [[ -n ${COMPREPLY[*]} ]] || _filedir
  fi
  unset -f commands_in
} &&
  complete -F _touchstone touchstone
