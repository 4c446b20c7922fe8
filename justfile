# `just` lists the recipes.
_default:
    @just --list

# Serve on loopback with a temporary store and an example map.
demo:
    cargo run --release -- demo

# Everything the README's test command runs.
test:
    cargo test --workspace

# Format, lint, documentation, licences.
lint:
    cargo fmt --all --check
    cargo clippy --workspace --all-targets -- -D warnings
    RUSTDOCFLAGS="-D warnings" cargo doc --workspace --no-deps --document-private-items
    cargo deny check bans licenses sources

# Exports of three maps, read by other people's programs (Python and GDAL).
exports:
    cargo build --release
    tests/exports/run

# The dashboard: its committed page from its sources (Node.js 20.19 or later).
web:
    npm --prefix web ci
    npm --prefix web run build

# The dashboard in a browser, on a real service.
web-test:
    cargo build --release
    web/tests/run

# Look for bytes that make a reader fail, each target for so many seconds (nightly toolchain, cargo-fuzz).
fuzz SECONDS="180":
    fuzz/run {{SECONDS}}

# Every stage on a part of a site, then the paper's size beside the exact march.
bench:
    cargo bench
    cargo run --release --example paper_scale

# Re-bless golden data: expected texts, golden files and the OpenAPI document.
bless:
    UPDATE_EXPECT=1 cargo test --workspace
    cargo run -- openapi --write openapi

# What continuous integration runs.
ci:
    bash .ci/run

# Print how well real maps, drawings and offices are read; `just measure drawings --seeds 21..28 --only pods` a part of it.
measure *WHAT="real drawings offices":
    cargo run --release --example accuracy -- {{WHAT}}

# Fill all tables of docs/accuracy.md: those above, the zoo, turned sites, maps of generate.py in MAPS/{seen,unseen,paper}.
accuracy MAPS:
    cargo run --release --example accuracy -- real drawings offices steadiness --rooms --write --layout 1..2 \
        --zoo seen=1..2 --zoo unseen=5..6 --rotation 1 \
        --generated seen={{MAPS}}/seen --generated unseen={{MAPS}}/unseen --paper-size {{MAPS}}/paper
