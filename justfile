# All tests.
test:
    cargo test --release --locked

# The Python package in a virtual environment of its own, with its tests.
python:
    python3 -m venv target/venv
    target/venv/bin/pip install --quiet '.[test]'
    target/venv/bin/python -m pytest -q python/tests

# Everything that runs before a change is accepted.
ci:
    .ci/run

# What a release offers: static programs, wheels and checksums in target/dist, tried; as arguments other architectures than this machine's.
dist *architectures:
    .ci/dist {{architectures}}

# Solve a case: a file, an embedded name, or nothing for the default.
solve *arguments:
    cargo run --release --locked -- solve {{arguments}}

# The book and the page that computes, in target/book; with arguments such as `--write` or `--only limit`. After `just python` with all pages run.
book *arguments:
    rustup target add wasm32-unknown-unknown
    cargo build --release --locked --bin percoat
    cargo build --profile page --locked --target wasm32-unknown-unknown -p percoat-page
    cargo run --locked -p percoat-book -- --wasm target/wasm32-unknown-unknown/page/percoat_page.wasm \
        {{ if path_exists("target/venv/bin/python") == "true" { "--python target/venv/bin/python" } else { "" } }} {{arguments}} target/book

# Every study afresh: report and figures in validation/, to be committed with what changed them.
validate:
    cargo run --release --locked -- validate --output validation

# The library's documentation.
doc:
    cargo doc --no-deps --locked --open

# Formatting and lints.
lint:
    cargo fmt --all --check
    cargo clippy --workspace --all-targets --locked -- -D warnings

# Compute the multiprecision reference of the kernel again (needs mpmath).
kernel-reference:
    python3 validation/kernel/generate.py

# Whether the present tree is slower than the commit before, or another: short cases by turns, then whole commands phase by phase.
bench-quick commit="HEAD^" rounds="7":
    benches/quick.sh {{commit}} {{rounds}}
    python3 benches/waits.py target/before/release/percoat --rounds 3

# Whole commands phase by phase beside the commit before, or another.
bench-waits *arguments:
    python3 benches/waits.py {{arguments}}

# percoat beside its peers; what it installs, and what it needs, stands at the head of the script.
bench-peers *arguments:
    python3 benches/peers.py target/peers {{arguments}}
