# shellcheck shell=bash
# Sourced by scripts/test: the tests of a build with sanitizers. It is made of a copy of the sources, inside build/ and in
# a hidden folder, because rosrun and roslaunch look for programs everywhere below a package and would find all of them
# twice.

# testSanitizedCopy [OPTION]...: scripts/test with these options in the copy; does not return.
testSanitizedCopy() {
  local copy=$build/.sanitized entry
  mkdir -p "$copy"
  find "$copy" -mindepth 1 -maxdepth 1 ! -name build ! -name devel -exec rm -rf {} +
  for entry in "$repository"/* "$repository"/.[!.]*; do
    case "${entry##*/}" in
      build | devel | install | demo_out | .git) ;;
      *) cp -a "$entry" "$copy/" ;;
    esac
  done
  export SANITIZE=address,undefined
  local common=exitcode=99:print_stacktrace=1:log_path=$copy/build/sanitizer_reports/report
  export ASAN_OPTIONS=$common:detect_leaks=1:strict_string_checks=1:check_initialization_order=1:detect_stack_use_after_return=1
  ASAN_OPTIONS+=:suppressions=$copy/scripts/faults_of_others.txt
  export UBSAN_OPTIONS=$common LSAN_OPTIONS=suppressions=$copy/scripts/leaks_of_others.txt:print_suppressions=0
  rm -rf "$copy/build/sanitizer_reports"
  mkdir -p "$copy/build/sanitizer_reports"
  exec "$copy/scripts/test" --no-install "$@"
}

# The nodelet manager of the system loads our library, and the runtime must be in a process before that: rosrun and
# roslaunch take the first program of a name, which is this one.
wrapNodelets() {
  local wrapper=$repository/devel/lib/nodelet/nodelet
  mkdir -p "${wrapper%/*}"
  cat > "$wrapper" << END
#!/bin/sh
LD_PRELOAD=$(gcc -print-file-name=libasan.so):$(gcc -print-file-name=libubsan.so) exec /usr/lib/nodelet/nodelet "\$@"
END
  chmod +x "$wrapper"
}
