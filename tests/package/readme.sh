#!/usr/bin/env bash
# What README.md names exists: commands with their subcommands and options, linked files; its program compiles.
# Usage: readme.sh SOURCE_DIR CC PROGRAM...   (PROGRAM: paths of the commands that have --help)
set -euo pipefail
cd "$1"
compiler=$2
shift 2
failures=0

fail() {
    printf 'README.md: %s\n' "$*"
    failures=1
}

# help_of WORDS...: the help of a command, or of its subcommand.
help_of() {
    local program
    for program in "${programs[@]}"; do
        [[ ${program##*/} == "$1" ]] || continue
        shift
        "$program" "$@" --help
        return
    done
    return 1
}

programs=("$@" scripts/demo scripts/test scripts/accuracy)
declare -A names
for program in "${programs[@]}"; do names[${program##*/}]=1; done
names[minirt-viewer]=1 # left out of some builds

# Commands anywhere: every word that looks like one of the project's.
while read -r name; do
    [[ -n ${names[$name]:-} ]] || fail "there is no command $name"
done < <(grep -oE '(minirt-[a-z]+|scripts/[a-z]+)' README.md | sed 's|scripts/||' | sort -u)

minirtc_help=$(help_of minirtc)
while read -r subcommand; do
    grep -qE "^ +$subcommand( |\$)" <<<"$minirtc_help" || fail "minirtc has no command $subcommand"
done < <(grep -oE 'minirtc [a-z]+' README.md | cut -d' ' -f2 | sort -u)

# Options, as written in code, belong to some command.
all_help=$(help_of minirtc bake; help_of minirtc inspect; help_of minirt-render; help_of minirt-cost; help_of minirt-bench; help_of demo; help_of test; cmake --help)
while read -r option; do
    grep -qe "$option" <<<"$all_help" || fail "no command has $option"
done < <(grep -oE '(^|[` ])--[a-z][a-z-]+' README.md | grep -oE -- '--[a-z-]+' | grep -vxE -- '--(help|preset|install|build)' | sort -u)

while read -r target; do
    [[ -e $target ]] || fail "there is no $target"
done < <(grep -oE '\]\([^)#:]+' README.md | cut -c3- | sort -u)

# shellcheck disable=SC2016
sed -n '/^```c$/,/^```$/p' README.md | sed '1d;$d' | "$compiler" -std=c99 -Wall -Wextra -Werror -I. -x c -fsyntax-only - ||
    fail "its program does not compile"

exit $failures
