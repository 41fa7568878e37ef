# Environment of every script here; to be sourced. Sets `root`, `build_ros`, `build_core`.
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build_ros=$root/build/ros
build_core=$root/build/core

# catkin's generators, make and roslaunch split such a path, but only after minutes.
if [[ $root == *[][:space:]\"\'\`\$\&\;\|\<\>\(\){}*?!#\\:%[]* ]]; then
  echo "${0##*/}: catkin cannot build in '$root': move the clone to a path without blanks, quotes, brackets and the like" >&2
  exit 2
fi

# catkin needs the system's python3: another one first on PATH fails with "No module named catkin_pkg".
export PATH="/usr/bin:$PATH"

# source_if_there SETUP_FILE [--extend]: --extend keeps the workspace that is sourced already. ROS setup files read
# variables that may be unset.
source_if_there() {
  local setup_file=$1
  shift
  if [ -f "$setup_file" ]; then set +u; source "$setup_file" "$@"; set -u; fi
}

# ROS addresses its masters by this name; a minimal system has no /etc/hosts.
require_localhost() {
  getent hosts localhost >/dev/null || {
    echo "localhost has no address: echo '127.0.0.1 localhost' >>/etc/hosts" >&2
    exit 1
  }
}

# show_usage LINES ARGUMENT: prints the script's head; exits with 0 for --help, with 2 for an unknown argument.
show_usage() {
  [[ $2 != --help && $2 != -h ]] || { sed -n "2,$1s/^# //p" "$0"; exit 0; }
  { [ -z "$2" ] || echo "${0##*/}: unknown option '$2'"; sed -n "2,$1s/^# //p" "$0"; } >&2
  exit 2
}

# A free port for a private ROS master.
free_port() {
  /usr/bin/python3 -c 'import socket; s = socket.socket(); s.bind(("localhost", 0)); print(s.getsockname()[1])'
}
