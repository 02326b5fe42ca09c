#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
#
# tools/sanitize.sh [asan|tsan]... [FILTER...]: the test suite under the address and undefined-behaviour
# sanitizers, then under the thread sanitizer. Suppressions are for third-party libraries only and stand
# in tools/sanitize/.
set -euo pipefail
cd "$(dirname "$0")/.."
root=$PWD
. tools/lib.sh

presets=() filters=()
for word in "$@"; do
  case $word in
    asan | tsan) presets+=("$word") ;;
    *) filters+=("$word") ;;
  esac
done
[ ${#presets[@]} -gt 0 ] || presets=(asan tsan)

mapfile -t needed < <(packages run test)
node_usable || needed+=(nodejs npm)
install "${needed[@]}"
# Journeys through the studio have a server to watch.
page_packages

# A finding ends the program that made it, so that it counts as a failed test.
export ASAN_OPTIONS=detect_stack_use_after_return=1:strict_init_order=1:check_initialization_order=1
export UBSAN_OPTIONS=print_stacktrace=1:halt_on_error=1
export LSAN_OPTIONS=suppressions=$root/tools/sanitize/lsan.supp:print_suppressions=0
export TSAN_OPTIONS=halt_on_error=1:second_deadlock_stack=1:suppressions=$root/tools/sanitize/tsan.supp

status=0
for preset in "${presets[@]}"; do
  build "$preset" || { status=1 && continue; }
  say "${bold}$preset${plain}"
  python3 -B tools/run_tests.py "build/$preset" --jobs "$(jobs)" --timeout 3600 --exclude-label check \
    ${filters[@]+"${filters[@]}"} || status=1
done
exit $status
