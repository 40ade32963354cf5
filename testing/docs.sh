#!/usr/bin/env bash
# What the documents name exists: linked files, files in backquotes (but for Blur, the example of a new step), and the
# settings in docs/parameters.md; and they use the words of the glossary. Prints what breaks that and fails.
cd "$(dirname "${BASH_SOURCE[0]}")/.." || exit 2
status=0
missing() { echo "$1: $2"; status=1; }
# What a link to a page can end with: its <a id>, and its headings as GitHub writes them.
anchors_of() {
  sed -nE 's/.*<a id="([^"]*)">.*/\1/p' "$1"
  sed -nE 's/^#+ //p' "$1" | tr 'A-Z ' 'a-z-' | tr -cd 'a-z0-9_\n-'
}
documents=(README.md CONTRIBUTING.md docs/*.md)
for document in "${documents[@]}"; do
  folder=$(dirname "$document")
  while read -r link; do
    [ -e "$folder/${link%%#*}" ] || missing "$document" "there is no $link to link to"
    case $link in
      *.md#*) anchors_of "$folder/${link%%#*}" | grep -qxF "${link#*#}" || missing "$document" "there is no $link to link to" ;;
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
# Every reason that a diagnosis can give has a row of docs/troubleshooting.md.
causes=$(sed -n '/^enum class LossCause/,/^};/s/^  \([A-Z][A-Za-z]*\).*/\1/p' core/pose/diagnosis/PoseDiagnosis.h)
[ "$(wc -w <<<"$causes")" -gt 10 ] || missing docs/troubleshooting.md "the reasons of core/pose/diagnosis/PoseDiagnosis.h are not found"
for cause in $causes; do
  grep -q "^|.*(\`$cause\`) |" docs/troubleshooting.md || missing docs/troubleshooting.md "no row for the reason $cause"
done
# The picture of all frames is that of its script.
/usr/bin/python3 testing/evaluation/frames.py /dev/stdout | cmp -s - docs/images/frames.svg ||
  missing docs/robot.md "docs/images/frames.svg is not what testing/evaluation/frames.py draws"
# The settings of docs/parameters.md: all fields of each struct that it names, with their defaults as the headers of core/
# have them ("STRUCT FIELD DEFAULT"), but for threads and structs within; and its properties are those of xml/ and the table of choices.
parameters=docs/parameters.md
mapfile -t headers < <(find core -name '*.h')
has=$(sed -nE 's/^\| `([a-z][A-Za-z]*)` \| ([^|]*[^| ]) \|.*/field \1 \2/p; s/^`([A-Z][A-Za-z]*)`.*/struct \1/p' "$parameters" |
  awk '$1 == "struct" { name = $2 } $1 == "field" { sub(/^field /, ""); print name, $0 }' | sort)
structs=$(sed -nE 's/^`([A-Z][A-Za-z]*)`.*/\1/p' "$parameters")
[ "$(wc -l <<<"$structs")" -gt 1 ] || missing "$parameters" "no settings struct is named"
wanted=$(awk -v named="$structs" '
  BEGIN { split(named, list); for (i in list) { isNamed[list[i]] = 1 } }
  /^struct [A-Za-z]+$/ { name = $2 }
  /^};/ { name = "" }
  name in isNamed && /^  [A-Za-z].*( = .*|[{] .* [}]);/ {
    sub(/;.*/, "")
    sub(/[{] /, " = ")
    sub(/ [}]/, "")
    field = value = $0
    sub(/ = .*/, "", field)
    sub(/.* /, "", field)
    sub(/^[^=]* = /, "", value)
    gsub(/[A-Za-z0-9]+::/, "", value)
    sub(/^true$/, "on", value)
    sub(/^false$/, "off", value)
    gsub(/\.0 /, " ", value)
    gsub(/\.0,/, ",", value)
    sub(/\.0$/, "", value)
    of[name "." field] = value
  }
  END {
    for (key in of) {
      other = of[key]
      value = sub(/\(\)\./, ".", other) ? of[other] : of[key]
      if (key !~ /\.threads$/) { sub(/\./, " ", key); print key, value }
    }
  }' "${headers[@]}" | sort)
differ=$(diff <(echo "$wanted") <(echo "$has") | sed -nE 's/^< /core has /p; s/^> /the page has /p')
[ -z "$differ" ] || missing "$parameters" "$differ"
while read -r name; do
  missing "$parameters" "neither core/ nor xml/ knows $name"
done < <(grep -oE '`[A-Z][A-Za-z]*`' "$parameters" | tr -d '`' | sort -u |
  comm -23 - <(grep -rohE --include='*.h' --include='*.xml' --include=choices.json '[A-Z][A-Za-z]*' core xml filters/ppfmeam | sort -u))
exit $status
