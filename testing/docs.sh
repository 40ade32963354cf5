#!/usr/bin/env bash
# What the documents name exists: linked files, files in backquotes (but for Blur, the example of a new step), and the
# settings in docs/method.md; and they use the words of the glossary. Prints what breaks that and fails.
cd "$(dirname "${BASH_SOURCE[0]}")/.." || exit 2
status=0
missing() { echo "$1: $2"; status=1; }
documents=(README.md CONTRIBUTING.md docs/*.md)
for document in "${documents[@]}"; do
  folder=$(dirname "$document")
  while read -r link; do
    [ -e "$folder/${link%%#*}" ] || missing "$document" "there is no $link to link to"
    case $link in
      *evaluation.md#*) grep -qs "<a id=\"${link#*#}\">" docs/evaluation.md ||
        missing "$document" "docs/evaluation.md has no ${link#*#}" ;;
    esac
  done < <(grep -oE '\]\([^):# ]+\.[a-z]+(#[^)]*)?\)' "$document" | sed 's/^](//; s/)$//')
  while read -r file; do
    [ -e "$file" ] || missing "$document" "there is no $file"
  done < <(grep -oE '`(core|filters|xml|plugin|testing|examples|cmake|docs)/[A-Za-z0-9_/]+\.[A-Za-z]+`' "$document" | tr -d '`' | grep -v Blur | sort -u)
done
# Words that docs/glossary.md has better ones for.
if grep -nwiE 'settles?|settled|glances?|own frame|in sight|looked past|judged points' "${documents[@]}"; then
  missing docs "the glossary has the field's words for these"
fi
while read -r name; do
  grep -rqwF --include='*.h' "$name" core || missing docs/method.md "no header of core/ knows the setting $name"
done < <(grep '^\*Settings\*' docs/method.md | grep -oE '`[A-Za-z]+`' | tr -d '`' | sort -u)
exit $status
