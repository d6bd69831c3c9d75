#!/usr/bin/env bash
# Opens every format of a report in a real reader: HTML in headless Chromium, workbooks in
# LibreOffice, LaTeX in a plain TeX Live, Markdown in GitHub's own renderer, CSV in LibreOffice and
# in Python's csv module. Certificates go to all of them, and the digital one to xmllint and pydcc.
#
# usage: tests/readers.sh [--no-install] [GROUP...]     groups: html latex markdown workbook csv
#                                                       certificate
#
# What it needs is installed (Debian packages as root; Python packages in an environment of their
# own). What it makes stays in target/readers (or $READERS_DIR), screenshots among it, to be looked
# at. DCC_SCHEMAS is a folder with dcc-3.2.1/dcc.xsd and dcc-3.1.2/dcc.xsd of the Digital Calibration
# Certificate, each beside what it imports; without it digital certificates are not validated, and
# that is said.
# It says what it did, goes on after a failure, and ends with 1 if there was one.
set -uo pipefail
cd "$(dirname "$0")/.."

INSTALL=yes
if [ "${1:-}" = --no-install ]; then INSTALL=no; shift; fi
GROUPS_WANTED=("$@")
DIR=$(realpath -m "${READERS_DIR:-target/readers}")
mkdir -p "$DIR"

# ---------------------------------------------------------------- what it says

DONE=0
FAILED=0

say() { printf '%s\n' "$*"; }
pass() { DONE=$((DONE + 1)); say "  ok    $*"; }
fail() { FAILED=$((FAILED + 1)); say "  FAIL  $*"; }

# check WHAT COMMAND...: the command's output is shown only where it fails
check() {
  local what=$1 log="$DIR/last.log"
  shift
  if "$@" > "$log" 2>&1; then pass "$what"; else fail "$what"; sed 's/^/        /' "$log"; fi
}

wanted() {
  [ ${#GROUPS_WANTED[@]} -eq 0 ] && return 0
  local group
  for group in "${GROUPS_WANTED[@]}"; do [ "$group" = "$1" ] && return 0; done
  return 1
}

# ---------------------------------------------------------------- what it needs

# packages COMMAND PACKAGE...: installs the packages if the command is missing
packages() {
  local command=$1
  shift
  if command -v "$command" > /dev/null; then say "  found $command"; return 0; fi
  if [ $INSTALL = no ] || [ "$(id -u)" != 0 ]; then
    fail "$command is missing: apt-get install $*"
    return 1
  fi
  say "  installing $*"
  apt-get update > "$DIR/apt.log" 2>&1
  DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends "$@" \
    >> "$DIR/apt.log" 2>&1 && command -v "$command" > /dev/null && return 0
  fail "$command cannot be installed: $DIR/apt.log"
  return 1
}

# python MODULE...: an environment with the modules
PYTHON="$DIR/venv/bin/python"
python() {
  local missing=()
  [ -x "$PYTHON" ] || python3 -m venv "$DIR/venv" > "$DIR/venv.log" 2>&1
  local module
  for module in "$@"; do "$PYTHON" -c "import importlib.util, sys; sys.exit(importlib.util.find_spec(\"$module\") is None)" 2> /dev/null || missing+=("$module"); done
  [ ${#missing[@]} -eq 0 ] && { say "  found Python with $*"; return 0; }
  [ $INSTALL = no ] && { fail "Python modules are missing: ${missing[*]}"; return 1; }
  say "  installing ${missing[*]} in $DIR/venv"
  "$PYTHON" -m pip install --quiet "${missing[@]/#dcc/pydcc}" >> "$DIR/venv.log" 2>&1 && return 0
  fail "${missing[*]} cannot be installed: $DIR/venv.log"
  return 1
}

program() {
  if [ -n "${GUMPTION:-}" ]; then say "  program $GUMPTION"; return 0; fi
  say "  building the program"
  cargo build --quiet --release || { say "it does not build"; exit 1; }
  GUMPTION="${CARGO_TARGET_DIR:-target}/release/gumption"
}

# ---------------------------------------------------------------- the reports

# name, then the arguments of `run`: one and several outputs, a sweep, correlations and paired
# readings, components and groups, few degrees of freedom, no trials, no GUM evaluation
CASES=(
  "plane        models/inclined_plane.json"
  "spurious     models/inclined_plane_spurious.json"
  "sweep        models/measuring_chain_frequencies.json"
  "impedance    tests/cases/gum-h2-impedance-normal/model.json"
  "paired       tests/cases/feat-paired-two/model.json"
  "components   tests/cases/feat-components-tilt/model.json"
  "groups       tests/cases/feat-subtotals-groups/model.json"
  "readings     tests/cases/feat-coverage-factor-five-readings/model.json"
  "attenuator   tests/cases/ea402-s7-step-attenuator/model.json"
  "no_trials    tests/cases/feat-trials-zero/model.json"
  "undefined    tests/cases/feat-dof-undefined-normals/model.json"
  "square_root  tests/readers/square_root.json"
  "every_step   tests/readers/every_operation.json"
)

# each_case COMMAND...: the command with name and arguments of each case
each_case() {
  local line name model
  for line in "${CASES[@]}"; do
    read -r name model <<< "$line"
    "$@" "$name" "$model"
  done
}

# report NAME MODEL FORMAT: the report
report() {
  local trials=200000
  [ "$1" = no_trials ] && trials=0
  "$GUMPTION" run "$2" --format "$3" --output "$DIR/$1.$3" --quiet --trials $trials
}

# ---------------------------------------------------------------- the readers

# page FILE: a screenshot without a word on the console, and a print
CHROMIUM_OPTIONS=(--headless --no-sandbox --disable-gpu --disable-background-networking
  --disable-component-update --disable-sync --hide-scrollbars)
page() {
  local file=$1 base=${1%.html} user
  user=$(mktemp -d)
  timeout 120 chromium "${CHROMIUM_OPTIONS[@]}" --user-data-dir="$user" --enable-logging=stderr \
    --log-level=0 --window-size=860,"${2:-2400}" --screenshot="$base.png" "file://$file" \
    > "$base.console" 2>&1 || { cat "$base.console"; rm -rf "$user"; return 1; }
  timeout 120 chromium "${CHROMIUM_OPTIONS[@]}" --user-data-dir="$user" --no-pdf-header-footer \
    --print-to-pdf="$base.print.pdf" "file://$file" > /dev/null 2>&1
  rm -rf "$user"
  if grep -F CONSOLE "$base.console"; then return 1; fi
  [ -s "$base.png" ] && [ -s "$base.print.pdf" ]
}

html_case() {
  check "$1: html is written" report "$1" "$2" html
  check "$1: Chromium shows and prints it without an error" page "$DIR/$1.html"
}

tex() {
  local file=$1 base=${1%.latex}
  mkdir -p "$base.tex" && cp "$file" "$base.tex/report.tex"
  # its figures
  find "$(dirname "$base")" -maxdepth 1 -name "$(basename "$base")-*.pdf" -exec cp {} "$base.tex" \;
  # the second run knows how many pages there are
  (cd "$base.tex" && for _ in 1 2; do
    timeout 120 pdflatex -interaction=nonstopmode -halt-on-error report.tex || exit 1
  done) || return 1
  # a table that is too wide by more than a letter is a mistake
  if grep -E 'Overfull \\hbox \(([5-9]|[1-9][0-9]+)\.' "$base.tex/report.log"; then return 1; fi
  [ -s "$base.tex/report.pdf" ]
}

latex_case() {
  check "$1: LaTeX is written" report "$1" "$2" latex
  check "$1: pdflatex compiles it" tex "$DIR/$1.latex"
}

github() {
  local file=$1
  cmark-gfm --extension table --extension strikethrough --extension autolink "$file" \
    > "$file.html" || return 1
  # as many tables as rules below headers, and no pipe left over in a paragraph
  local rules tables
  rules=$(grep -cE '^\| -' "$file")
  tables=$(grep -c '<table>' "$file.html")
  [ "$rules" = "$tables" ] || { echo "$rules tables written, $tables shown"; return 1; }
  ! grep -E '^<p>\|' "$file.html"
}

markdown_case() {
  check "$1: Markdown is written" report "$1" "$2" markdown
  check "$1: GitHub's renderer shows its tables" github "$DIR/$1.markdown"
}

# office TO FILE FOLDER: a file converted by LibreOffice, which computes every formula anew
office() {
  local profile="$DIR/office"
  mkdir -p "$profile/user"
  cp tests/readers/office.xcu "$profile/user/registrymodifications.xcu"
  timeout 180 soffice "-env:UserInstallation=file://$profile" --headless --convert-to "$1" \
    --outdir "$3" "$2" > "$3.office.log" 2>&1 || { cat "$3.office.log"; return 1; }
  # it may run without Java, which it needs for databases only
  if grep -v javaldx "$3.office.log" | grep -iE 'warning|error'; then return 1; fi
}

workbook() {
  local name=$1 model=$2
  report "$name" "$model" json || return 1
  rm -rf "$DIR/$name.recalculated" && mkdir -p "$DIR/$name.recalculated"
  office xlsx "$DIR/$name.xlsx" "$DIR/$name.recalculated" || return 1
  "$PYTHON" tests/readers/workbook.py "$DIR/$name.json" "$DIR/$name.xlsx" \
    "$DIR/$name.recalculated/$name.xlsx"
}

# changed NAME MODEL: estimates and standard uncertainties changed in the workbook give what the
# changed model gives
changed() {
  local name=$1 model=$2
  rm -rf "$DIR/$name.changed" && mkdir -p "$DIR/$name.changed"
  "$PYTHON" tests/readers/change.py "$GUMPTION" "$model" "$DIR/$name.xlsx" \
    "$DIR/$name.changed/$name-in.xlsx" "$DIR/$name.changed/model.json" || return 1
  office xlsx "$DIR/$name.changed/$name-in.xlsx" "$DIR/$name.changed/out" || return 1
  "$GUMPTION" run "$DIR/$name.changed/model.json" --trials 0 --format json --quiet \
    --output "$DIR/$name.changed/answer.json" || return 1
  "$PYTHON" tests/readers/workbook.py "$DIR/$name.changed/answer.json" - \
    "$DIR/$name.changed/out/$name-in.xlsx"
}

workbook_case() {
  check "$1: workbook is written" report "$1" "$2" xlsx
  check "$1: LibreOffice computes the same y, u, k and U to 1e-9" workbook "$1" "$2"
}

# a workbook on a terminal is refused with exit code 2
on_a_terminal() {
  script -qec "'$GUMPTION' run models/inclined_plane.json --format xlsx --trials 0" "$DIR/terminal"
  [ $? = 2 ] && grep -q 'cannot be shown in a terminal' "$DIR/terminal"
}

spreadsheet() {
  local name=$1
  rm -rf "$DIR/$name.sheet" && mkdir -p "$DIR/$name.sheet"
  office xlsx "$DIR/$name.csv" "$DIR/$name.sheet" || return 1
  "$PYTHON" tests/readers/table.py "$DIR/$name.csv" "$DIR/$name.sheet/$name.xlsx" "$DIR/$name.json"
}

csv_case() {
  check "$1: CSV is written" report "$1" "$2" csv
  check "$1: JSON is written" report "$1" "$2" json
  check "$1: LibreOffice and Python read the CSV alike, with the numbers of the JSON" spreadsheet "$1"
}

# certificates: name and certificate file
CERTIFICATES=(
  "worked_day   models/certificates/three_axis_accelerometer.json"
  "correlated   tests/readers/certificate.json"
)

certificate() {
  "$GUMPTION" certificate "$2" --format "$3" --output "$DIR/$1.$3" --allow-path models --quiet
}

tables() {
  local name=$1
  rm -rf "$DIR/$name.sheet" && mkdir -p "$DIR/$name.sheet"
  office xlsx "$DIR/$name.xlsx" "$DIR/$name.sheet" || return 1
  "$PYTHON" tests/readers/certificate.py "$DIR/$name.json" "$DIR/$name.csv" \
    "$DIR/$name.sheet/$name.xlsx"
}

# the stylesheet beside a digital certificate makes a page of it with the stated figures, which
# Chromium shows; in every language of the certificate
shown() {
  local name=$1 base="$DIR/$1.stylesheet" language
  "$GUMPTION" certificate "$2" --format dcc --stylesheet --output "$base.xml" \
    --allow-path models --quiet || return 1
  for language in $(sed -n 's/.*usedLangCodeISO639_1>\(..\)<.*/\1/p' "$base.xml"); do
    xsltproc --nonet --stringparam lang "$language" "$base.xsl" "$base.xml" \
      > "$base.$language.html" || return 1
    "$PYTHON" - "$DIR/$name.json" "$base.$language.html" << 'END' || return 1
import html, json, re, sys
answer, page = (open(name, encoding="utf-8").read() for name in sys.argv[1:])
cells = [html.unescape(re.sub("<[^>]*>", "", cell)).strip()
         for cell in re.findall("<td[^>]*>(.*?)</td>", page, re.S)]
for row in json.loads(answer)["rows"]:
    stated = row["stated"]
    for figure in (stated["value"], stated["expanded_uncertainty"]):
        if str(figure) not in cells:
            sys.exit(f"{figure} is not on the page")
END
    page "$base.$language.html" || return 1
  done
}

certificate_case() {
  local name=$1 file=$2 format
  for format in json csv xlsx markdown latex html dcc; do
    check "$name: $format is written" certificate "$name" "$file" "$format"
  done
  check "$name: Chromium shows and prints it without an error" page "$DIR/$name.html"
  check "$name: pdflatex compiles it" tex "$DIR/$name.latex"
  check "$name: GitHub's renderer shows its tables" github "$DIR/$name.markdown"
  check "$name: LibreOffice and Python read the stated figures" tables "$name"
  check "$name: xsltproc shows the digital certificate with its stylesheet" shown "$name" "$file"
  check "$name: pydcc reads the stated figures" \
    "$PYTHON" tests/readers/digital_certificate.py "$DIR/$name.json" "$DIR/$name.dcc"
  if [ -n "${DCC_SCHEMAS:-}" ]; then
    local version
    for version in 3.2.1 3.1.2; do
      "$GUMPTION" certificate "$file" --format dcc --dcc-version $version --allow-path models \
        --output "$DIR/$name.$version.xml" --quiet
      check "$name: the digital certificate $version is valid" xmllint --nonet --noout \
        --schema "$DCC_SCHEMAS/dcc-$version/dcc.xsd" "$DIR/$name.$version.xml"
    done
  else
    say "  --    $name: not validated; DCC_SCHEMAS is not set"
  fi
}

# ---------------------------------------------------------------- all of it

say "what is needed"
program

if wanted html; then
  say "html in Chromium"
  packages chromium chromium fonts-dejavu && each_case html_case
fi
if wanted latex; then
  say "LaTeX in TeX Live"
  packages pdflatex texlive-latex-base texlive-latex-recommended texlive-science \
    texlive-fonts-recommended && each_case latex_case
fi
if wanted markdown; then
  say "Markdown in GitHub's renderer"
  packages cmark-gfm cmark-gfm && each_case markdown_case
fi
if wanted workbook; then
  say "workbooks in LibreOffice"
  if packages soffice libreoffice-calc && python openpyxl; then
    each_case workbook_case
    check "a terminal gets no workbook" on_a_terminal
    for name in plane attenuator readings every_step; do
      line=$(printf '%s\n' "${CASES[@]}" | grep "^$name ")
      check "$name: a changed input changes U as in the changed model" \
        changed "$name" "$(awk '{print $2}' <<< "$line")"
    done
  fi
fi
if wanted csv; then
  say "CSV in LibreOffice and Python"
  packages soffice libreoffice-calc && python openpyxl && each_case csv_case
fi

if wanted certificate; then
  say "certificates"
  packages chromium chromium fonts-dejavu && packages soffice libreoffice-calc &&
    packages pdflatex texlive-latex-base texlive-latex-recommended texlive-science \
      texlive-fonts-recommended &&
    packages cmark-gfm cmark-gfm && packages xmllint libxml2-utils && packages xsltproc xsltproc && python openpyxl dcc &&
    for line in "${CERTIFICATES[@]}"; do
      read -r name file <<< "$line"
      certificate_case "$name" "$file"
    done
fi

say "$DONE checks passed, $FAILED failed; what was made is in $DIR"
[ "$FAILED" = 0 ]
