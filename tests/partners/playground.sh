# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
#
# The playground: every example that the engine derives as WebAssembly, in node, is the same to the byte as the
# program's; the folder is small; and the page works in a browser.
most=3000000
tools/playground.sh "$out/page" || return 1
[ "$(gzipped "$out/page")" -le "$most" ] || { say "The folder has more than $most bytes by gzip" && return 1; }
step "Examples in WebAssembly" playground-bytes.log node tests/wasm/same_bytes.mjs "$gable" "$out" || return 1
tail -n 1 "$root/build/log/playground-bytes.log"
install chromium
(cd studio && step "The playground in a browser" playground-page.log node e2e/playground.mjs "$out/page" "$out") || return 1
cat "$root/build/log/playground-page.log"
