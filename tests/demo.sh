# Sourced by the checks of a running service: starts `stillage demo` on a free port and waits until its map is analysed.
# STILLAGE_BINARY names the program (target/release/stillage). Sets `service` and `map`, addresses, and `work`, a folder; both
# are gone when the script ends.
work=$(mktemp -d)
server=
trap 'if [ -n "$server" ]; then kill "$server"; fi; rm -rf "$work"' EXIT

"${STILLAGE_BINARY:-target/release/stillage}" demo --listen 127.0.0.1:0 >"$work/log" 2>&1 &
server=$!
for _ in $(seq 300); do
    grep -q '^Serving' "$work/log" && break
    kill -0 "$server" 2>/dev/null || { cat "$work/log"; exit 1; }
    sleep 1
done
map=$(grep -o 'http://[^ ]*/v1/maps/[0-9a-f-]*' "$work/log" | head -n 1)
service=${map%/v1/maps/*}

# A Python of its own in `$work/python` with the packages of a requirements file.
python_with() {
    python3 -m venv "$work/python"
    "$work/python/bin/pip" install --quiet --disable-pip-version-check -r "$1"
}
