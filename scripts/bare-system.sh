# Sourced by scripts that try turnscan where nothing is installed: a bare system of another release,
# in a folder. As root.

# make_bare SUITE FOLDER: bookworm, trixie, or noble (which needs ubuntu-keyring).
make_bare() {
  local suite=$1 folder=$2 mirror= components=main script=()
  case $suite in
    bookworm | trixie)
      # The same mirror as this system's, if it is Debian's; else debootstrap knows one.
      mirror=$(awk '($1 == "URIs:" || $1 == "deb") && $2 ~ /\/debian\/?$/ {print $2; exit}' \
        /etc/apt/sources.list.d/*.sources /etc/apt/sources.list 2>/dev/null || true)
      ;;
    # Debian's debootstrap makes all of Ubuntu's releases by one script.
    noble) components=main,universe script=(/usr/share/debootstrap/scripts/gutsy) ;;
    *) echo "unknown suite '$suite'; known: bookworm trixie noble" >&2 && return 2 ;;
  esac
  # A folder of mktemp is its owner's alone, and apt fetches as another user.
  chmod 755 "$folder"
  if ! debootstrap --variant=minbase --components=$components "$suite" "$folder" "$mirror" "${script[@]}" \
    >"$folder.log"; then
    tail -n 5 "$folder.log" >&2
    return 1
  fi
  rm -f "$folder.log"
  cp /etc/resolv.conf "$folder/etc/resolv.conf"
  enter_bare "$folder"
}

enter_bare() {
  mount -t proc proc "$1/proc"
  mount --bind /dev "$1/dev"
  # Else what is mounted below would be mounted below this system's /dev, too.
  mount --make-private "$1/dev"
  mount --bind /dev/pts "$1/dev/pts"
  mount -t tmpfs tmpfs "$1/dev/shm"
}

# remove_bare FOLDER: with the processes that run in it, and never what is mounted in it.
remove_bare() {
  local mounted process
  for process in /proc/[0-9]*; do
    if [ "$(readlink "$process/root")" = "$1" ]; then kill -KILL "${process#/proc/}" || true; fi
  done 2>/dev/null
  for mounted in dev/shm dev/pts dev proc ccache; do
    if mountpoint -q "$1/$mounted"; then umount "$1/$mounted" || umount --lazy "$1/$mounted"; fi
  done
  if grep -q " $1/" /proc/self/mounts; then
    echo "$1 is still in use, and is left" >&2
    return 1
  fi
  rm -rf --one-file-system "$1"
}

# inside FOLDER COMMAND...
inside() {
  local folder=$1
  shift
  chroot "$folder" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LANG=C.UTF-8 TERM=dumb "$@"
}

install_inside() {
  local folder=$1
  shift
  inside "$folder" apt-get update -qq
  inside "$folder" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends \
    -o Dpkg::Use-Pty=0 "$@" >/dev/null
}

# In MB, as the packages state it.
installed_size() {
  inside "$1" dpkg-query -W -f='${Installed-Size}\n' | awk '{sum += $1} END {printf "%d\n", sum / 1024}'
}
