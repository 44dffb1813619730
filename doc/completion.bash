# Completion of crevasse's options, scenes and parameters in bash:
#
#     source doc/completion.bash
#
# The parameters after --set, --vary and --reference are those that the program
# prints; it is asked once a shell.

_crevasse_ask_parameters()
{
  [ -n "${_crevasse_parameters-}" ] ||
    _crevasse_parameters=$("$1" --print-parameters prm 2> /dev/null | awk '
      /^ *subsection / { sub(/^ *subsection /, ""); section = $0 "/" }
      /^ *end/         { section = "" }
      /^ *set /        { sub(/^ *set /, ""); sub(/ *=.*/, ""); print section $0 }')
}

# Names with spaces are quoted for the shell, as the word was begun.
_crevasse_complete_parameter()
{
  local word=${1#[\"\']} quote='"' name
  [[ ${COMP_WORDS[COMP_CWORD]} != \'* ]] || quote="'"
  word=${word//\\/}
  compopt -o nospace
  while read -r name; do
    [[ $name != "$word"* ]] || COMPREPLY+=("$quote$name=")
  done <<< "${_crevasse_parameters-}"
  # Of a single one bash would close the quotes, but its value is to come.
  [ ${#COMPREPLY[@]} != 1 ] || COMPREPLY+=("${COMPREPLY[0]}...")
}

# What compgen finds, a line each: names of files may contain spaces.
_crevasse_add()
{
  mapfile -t -O "${#COMPREPLY[@]}" COMPREPLY < <(compgen "$@")
}

_crevasse_complete_option()
{
  _crevasse_add -W "$("$1" "$2" --help 2> /dev/null |
    grep -o -e '--[a-z-]*' | sort -u)" -- "$3"
}

_crevasse()
{
  local program=${1/#\~\//$HOME/} word=$2 before=$3
  COMPREPLY=()
  case $before in
    --set | --vary | --reference)
      _crevasse_ask_parameters "$program" || return 0
      _crevasse_complete_parameter "$word" ;;
    --picture)
      compopt -o filenames
      _crevasse_add -f -X '!*.html' -- "$word" ;;
    --output)
      compopt -o filenames
      _crevasse_add -d -- "$word" ;;
    --print-parameters)
      _crevasse_add -W "prm json markdown schema" -- "$word" ;;
    --wall-time | --accuracy | --for | --exact | --error | --jobs | --from | --to | --lengths) ;;
    *)
      if [[ $word == -* ]]; then
        _crevasse_complete_option "$program" "${COMP_WORDS[1]/#-*/--help}" "$word"
      else
        compopt -o filenames
        _crevasse_add -d -- "$word"
        _crevasse_add -f -X '!*.prm' -- "$word"
        _crevasse_add -f -X '!*.json' -- "$word"
        [ "$COMP_CWORD" != 1 ] || _crevasse_add -W "sweep advise life report figures mesh temperature" -- "$word"
      fi ;;
  esac
  return 0
}

complete -F _crevasse crevasse
