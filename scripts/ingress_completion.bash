# Completes the command ingress in bash; to be sourced. The words come from `ingress --complete`.
_window_ingress_complete() {
  mapfile -t COMPREPLY < <("${COMP_WORDS[0]}" --complete "${COMP_WORDS[@]:1:COMP_CWORD}" 2>/dev/null | grep .)
}
complete -o default -F _window_ingress_complete ingress
