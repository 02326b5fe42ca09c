# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
#
# What the shell scripts share: words on the terminal, long steps with their output in a log, and the
# installation of packages. Sourced by scripts that have set `root` to the repository's root.

logs="$root/build/log"

if [ -t 1 ]; then
  terminal=1 bold=$'\e[1m' dim=$'\e[2m' red=$'\e[31m' plain=$'\e[0m' wipe=$'\r\e[K'
else
  terminal=0 bold='' dim='' red='' plain='' wipe=''
fi

say() { printf '%s\n' "$*"; }
die() {
  printf '%s%s%s\n' "$red" "$*" "$plain" >&2
  exit 1
}

# The jobs a build runs at once; GABLE_JOBS overrides the number of processors.
jobs() { echo "${GABLE_JOBS:-$(nproc)}"; }

# spell SECONDS: "8 s" or "2 min 05 s".
spell() {
  if [ "$1" -lt 60 ]; then echo "$1 s"; else printf '%d min %02d s\n' $(($1 / 60)) $(($1 % 60)); fi
}

# step LABEL LOG COMMAND...: runs COMMAND with its output in build/log/LOG. On a terminal the last line
# of the log is shown beside the label; elsewhere a line every half minute tells that it is alive. One
# line remains, and none where the step took under two seconds in a pipe. Returns the command's status
# after showing the end of the log of one that failed.
step() {
  local label=$1 log="$logs/$2" start=$SECONDS status=0 tick=0 pid last
  shift 2
  mkdir -p "$logs"
  "$@" >"$log" 2>&1 </dev/null &
  pid=$!
  trap "kill $pid 2>/dev/null; exit 130" INT TERM
  while kill -0 "$pid" 2>/dev/null; do
    tick=$((tick + 1))
    if [ "$terminal" = 1 ] && [ $((tick % 4)) = 0 ]; then
      # What a warning advises is no progress.
      last=$(tail -n 1 "$log" | sed '/^ *hint:/d' | tr -d '\r' | cut -c "1-$((${COLUMNS:-$(tput cols 2>/dev/null || echo 80)} - 30))")
      printf '%s%s %s%s %s%s' "$wipe" "$label" "$dim" "$(spell $((SECONDS - start)))" "$last" "$plain"
    elif [ "$terminal" = 0 ] && [ $((tick % 600)) = 0 ]; then
      say "  $label: $(spell $((SECONDS - start))) $(tail -n 1 "$log" | sed "/^ *hint:/d" | cut -c 1-80)"
    fi
    sleep 0.05
  done
  wait "$pid" || status=$?
  trap - INT TERM
  printf '%s' "$wipe"
  if [ "$status" != 0 ]; then
    tail -n "${GABLE_LOG_LINES:-60}" "$log" >&2
    printf '%s%s failed%s (all of its output: %s)\n' "$red" "$label" "$plain" "${log#"$root"/}" >&2
  elif [ $((SECONDS - start)) -ge 2 ]; then
    say "$label ${dim}$(spell $((SECONDS - start)))${plain}"
  fi
  return "$status"
}

# gzipped FOLDER: the bytes that a server sends for all its files where it compresses each by gzip.
gzipped() { find "$1" -type f -exec gzip -9c {} + | wc -c; }

# packages GROUP...: the names in tools/packages.txt.
packages() {
  local group
  for group in "$@"; do
    sed -n "s/^$group  *//p" "$root/tools/packages.txt"
  done | tr -s ' ' '\n'
}

# missing PACKAGE...: those that are not installed.
missing() {
  local known name
  known=$(dpkg-query -W -f '${db:Status-Status} ${Package}\n' 2>/dev/null | sed -n 's/^installed //p')
  for name in "$@"; do
    grep -qxF "$name" <<<"$known" || echo "$name"
  done
}

# As root, with sudo only where needed.
as_root() {
  if [ "$(id -u)" = 0 ]; then "$@"; else sudo "$@"; fi
}

apt_install() {
  as_root env DEBIAN_FRONTEND=noninteractive apt-get update || true
  as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends "$@"
}

# install PACKAGE...: installs the missing ones, and nothing but a look at the list of installed
# packages where none is. GABLE_NO_INSTALL=1 leaves the machine as it is.
install() {
  local names
  [ -z "${GABLE_NO_INSTALL:-}" ] || return 0
  if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
    say "This is not a Debian system; these packages, or what they are called here, must be there:"
    say "  $*"
    return 0
  fi
  mapfile -t names < <(missing "$@")
  [ "${#names[@]}" -gt 0 ] || return 0
  if [ "$(id -u)" != 0 ]; then
    command -v sudo >/dev/null || die "Install these first, as root: apt-get install ${names[*]}"
    say "Installing needs root: ${names[*]}"
    sudo -v
  fi
  step "Installing ${#names[@]} packages" apt.log apt_install "${names[@]}" ||
    die "Could not install: ${names[*]}"
}

# node_usable: a node of 18 or newer and an npm, wherever they come from.
node_usable() {
  local major
  command -v node >/dev/null && command -v npm >/dev/null || return 1
  major=$(node -p 'process.versions.node.split(".")[0]' 2>/dev/null) || return 1
  [ "$major" -ge 18 ]
}

# The packages of the studio's page, installed anew when their lock changes: the versions of the lock,
# which stays as it is. `npm ci` would ask for the lock to name what other platforms need as well.
install_page_packages() {
  (cd "$root/studio" && npm install --no-save --no-audit --no-fund --loglevel=error) &&
    cp "$root/studio/package-lock.json" "$root/studio/node_modules/installed.json"
}
page_packages() {
  cmp -s "$root/studio/package-lock.json" "$root/studio/node_modules/installed.json" ||
    step "Installing what the studio's page needs" page-packages.log install_page_packages
}
build_page() { (cd "$root/studio" && npm run --silent build); }

# What makes the documentation's site and looks at it.
install_site_packages() {
  (cd "$root/site" && npm ci --no-audit --no-fund --loglevel=error) &&
    cp "$root/site/package-lock.json" "$root/site/node_modules/installed.json"
}
site_packages() {
  cmp -s "$root/site/package-lock.json" "$root/site/node_modules/installed.json" ||
    step "Installing what the site needs" site-packages.log install_site_packages
}

# What the extension for editors and the tests of the language server need, in build/editors.
install_editor_packages() {
  mkdir -p "$root/build/editors"
  cp "$root/editors/vscode/package.json" "$root/editors/vscode/package-lock.json" "$root/build/editors/"
  (cd "$root/build/editors" && npm ci --no-audit --no-fund --loglevel=error) &&
    cp "$root/build/editors/package-lock.json" "$root/build/editors/installed.json"
}
editor_packages() {
  cmp -s "$root/editors/vscode/package-lock.json" "$root/build/editors/installed.json" ||
    step "Installing what the language server's tests need" editor-packages.log install_editor_packages
}

# build PRESET [TARGET...]: configures where needed and builds. Ninja itself runs CMake again when a
# file of the build description changed, so the configuration is done by hand only once.
build() {
  local preset=$1
  shift
  if [ ! -f "$root/build/$preset/build.ninja" ]; then
    step "Configuring $preset" "configure-$preset.log" cmake --preset "$preset" -S "$root" || return 1
  fi
  NINJA_STATUS='[%f/%t] ' step "Building $preset" "build-$preset.log" \
    ninja -C "$root/build/$preset" -j "$(jobs)" "$@"
}
