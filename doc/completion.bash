# Completion of crevasse's options, scenes and parameters in bash:
#
#     source doc/completion.bash
#
# The parameters after --set, --vary and --reference are those that the program
# prints; it is asked once a shell.

_crevasse_ask_for_parameters()
{
  [ -n "$_crevasse_parameters" ] ||
    _crevasse_parameters=$("$1" --print-parameters prm 2> /dev/null | awk '
      /^ *subsection / { sub(/^ *subsection /, ""); section = $0 "/" }
      /^ *end/         { section = "" }
      /^ *set /        { sub(/^ *set /, ""); sub(/ *=.*/, ""); print section $0 }')
}

# Names with spaces: each is a line, and is quoted for the shell.
_crevasse_complete_parameter()
{
  local word=${1#[\"\']} name
  compopt -o nospace
  _crevasse_ask_for_parameters "$2" # not in a subshell, which would forget them
  while read -r name; do
    [[ $name && $name == "${word//\\/}"* ]] && COMPREPLY+=("\"$name=")
  done <<< "$_crevasse_parameters"
  # Of a single one bash would close the quotes, but its value is to come.
  [ ${#COMPREPLY[@]} != 1 ] || COMPREPLY+=("${COMPREPLY[0]}...")
}

_crevasse()
{
  local program=$1 word=$2 before=$3
  COMPREPLY=()
  case $before in
    --set | --vary | --reference)
      _crevasse_complete_parameter "$word" "$program" ;;
    --output)
      COMPREPLY=($(compgen -d -- "$word")) ;;
    --print-parameters)
      COMPREPLY=($(compgen -W "prm json markdown" -- "$word")) ;;
    --wall-time | --exact | --error) ;;
    *)
      if [[ $word == -* ]]; then
        COMPREPLY=($(compgen -W "$("$program" "${COMP_WORDS[1]/#-*/--help}" --help 2> /dev/null |
          grep -o -e '--[a-z-]*')" -- "$word"))
      else
        compopt -o filenames
        COMPREPLY=($(compgen -d -- "$word") $(compgen -f -X '!*.@(prm|json)' -- "$word"))
        [ "$COMP_CWORD" = 1 ] && COMPREPLY+=($(compgen -W "sweep advise" -- "$word"))
      fi ;;
  esac
}

shopt -s extglob
complete -F _crevasse crevasse
