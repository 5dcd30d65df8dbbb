# shellcheck shell=bash
# What ./quartet, ./check and .ci/run share: install the packages that are missing, configure, build.
# Each step says one line when it has something to do and nothing otherwise. All of it goes to
# stderr, because stdout belongs to the program.

: "${root:?the caller sets it to the folder of the clone}"

say() { printf '%s: %s\n' "${0##*/}" "$*" >&2; }
die() {
  say "$@"
  exit 1
}

# packages SECTION...: the names that packages.txt lists for these sections.
packages() {
  local section name
  while read -r section name; do
    [[ " $* " == *" $section "* ]] && printf '%s\n' "$name"
  done <"$root/packages.txt"
  return 0
}

is_debian() { command -v dpkg-query >/dev/null && command -v apt-get >/dev/null; }

# run_logged LOG MESSAGE COMMAND...: says the message once the command has something to do, writes
# its output to the log and, on a terminal, shows the last line of it.
run_logged() {
  local log=$1 message=$2 line announced='' columns
  shift 2
  columns=$(tput cols 2>/dev/null) || columns=80
  "$@" 2>&1 </dev/null 9>&- | {
    while IFS= read -r line; do
      printf '%s\n' "$line" >&3
      # What ninja prints for a build that is up to date.
      case $line in *'Re-checking globbed directories'* | 'ninja: no work to do.') continue ;; esac
      [[ -n $announced ]] || say "$message"
      announced=yes
      if [[ -t 2 ]]; then printf '\r\033[K%s' "${line:0:columns-1}" >&2; fi
    done 3>"$log"
    if [[ -n $announced && -t 2 ]]; then printf '\r\033[K' >&2; fi
  }
}

# install_packages SECTION...: through apt-get, as root or with a sudo that can be used here.
install_packages() {
  is_debian || return 0 # configure tells what is needed
  local wanted installed missing=() name
  mapfile -t wanted < <(packages "$@")
  installed=$(dpkg-query -W -f '${Package} ${db:Status-Status}\n' "${wanted[@]}" 2>/dev/null) || true
  for name in "${wanted[@]}"; do
    [[ $'\n'$installed$'\n' == *$'\n'"$name installed"$'\n'* ]] || missing+=("$name")
  done
  ((${#missing[@]})) || return 0

  local sudo=() update='apt-get update' install="apt-get install -y --no-install-recommends ${missing[*]}"
  if ((EUID != 0)); then
    if ! command -v sudo >/dev/null; then
      die "packages are missing, and there is no sudo to install them with. Run as root:"$'\n'"  $update && $install"
    fi
    sudo=(sudo) update="sudo $update" install="sudo $install"
    # With a terminal sudo may ask for a password, now, before its output goes to a log.
    if ! sudo -n apt-get --version >/dev/null 2>&1 && { [[ ! -t 0 ]] || ! sudo -v; }; then
      die "packages are missing, and sudo does not let them be installed from here. Run:"$'\n'"  $update && $install"
    fi
  fi
  export DEBIAN_FRONTEND=noninteractive
  local log=$root/build/install.log apt=("${sudo[@]}" apt-get -o DPkg::Lock::Timeout=300)
  # The lists may be absent, as in a fresh container, or name versions that the mirror has dropped.
  # A failing update need not matter: one broken source of a third party is enough for it.
  run_logged "$log" "reading the package lists" "${apt[@]}" update ||
    say "apt-get update failed, going on with the old lists: $(tail -n 1 "$log")"
  if ! run_logged "$log" "installing ${#missing[@]} packages: ${missing[*]}" \
    "${apt[@]}" install -y --no-install-recommends "${missing[@]}"; then
    tail -n 20 "$log" >&2
    die "could not install the packages (whole log: $log). To try by hand:"$'\n'"  $update && $install"
  fi
}

# configure PRESET: only when there is no build folder of this clone yet or the presets changed;
# ninja itself configures again when a CMakeLists.txt changes.
configure() {
  local preset=$1 dir=$root/build/$1 log=$root/build/$1.configure.log version
  if [[ -f $dir/build.ninja && ! $root/CMakePresets.json -nt $dir/build.ninja ]] &&
    grep -qFx "CMAKE_HOME_DIRECTORY:INTERNAL=$root" "$dir/CMakeCache.txt"; then
    return 0
  fi
  version=$(cmake --version 2>/dev/null | sed -n 's/^cmake version //p') || true
  if [[ -n $version && $(printf '%s\n' 3.25 "$version" | sort -V | head -n 1) != 3.25 ]]; then
    die "CMake $version is too old: 3.25 or newer is needed (Debian 12, Ubuntu 23.04)"
  fi
  run_logged "$log" "configuring build/$preset" cmake -S "$root" --preset "$preset" --fresh && return 0
  cat "$log" >&2
  if ! is_debian; then
    say "this is not Debian or Ubuntu; the libraries and tools to install are, by their Debian names:"
    packages build test | sed 's/^/  /' >&2
  fi
  die "could not configure build/$preset"
}

# build PRESET TARGET
build() {
  local dir=$root/build/$1 log=$root/build/$1.build.log
  run_logged "$log" "building build/$1" cmake --build "$dir" --target "$2" && return 0
  # From the first failed command on: what ninja finished before it does not matter.
  sed -n '/^FAILED: /,$p; /^ninja: error/p; /^CMake Error/,$p' "$log" >&2
  die "could not build build/$1 (whole log: $log)"
}

# with_lock COMMAND...: one process at a time installs or builds.
with_lock() {
  mkdir -p "$root/build" 2>/dev/null || die "cannot create $root/build"
  [[ -w $root/build ]] || die "cannot write to $root/build"
  exec 9>"$root/build/lock"
  if command -v flock >/dev/null && ! flock -n 9; then
    say "waiting for another build to end"
    flock 9
  fi
  trap 'exit 130' INT
  "$@"
  trap - INT
  exec 9>&-
}

# prepare PRESET TARGET SECTION...: all of the above, after which the target is up to date.
prepare() {
  local preset=$1 target=$2
  shift 2
  install_packages "$@"
  configure "$preset"
  build "$preset" "$target"
}
