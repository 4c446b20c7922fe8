# syntax=docker/dockerfile:1

# Build: the image's toolchain, the locked dependencies, one binary.
FROM rust:1.95.0-bookworm AS build
# The image brings exactly this toolchain; do not let rust-toolchain.toml fetch another.
ENV RUSTUP_TOOLCHAIN=1.95.0
WORKDIR /stillage
COPY . .
RUN cargo build --release --locked --bin stillage && strip target/release/stillage

# Run: a small Debian with the same libc, a user without rights, curl for the health check.
FROM debian:bookworm-slim
RUN apt-get update \
    && apt-get install --yes --no-install-recommends curl \
    && rm -rf /var/lib/apt/lists/* \
    && useradd --system --uid 10001 --home-dir /data stillage \
    && install --directory --owner=stillage --group=stillage /data
COPY --from=build /stillage/target/release/stillage /usr/local/bin/stillage
USER stillage
VOLUME /data
EXPOSE 8080
HEALTHCHECK --interval=10s --timeout=3s --start-period=5s CMD ["curl", "--fail", "--silent", "http://127.0.0.1:8080/health/ready"]
# Whoever reaches the port may do everything, unless STILLAGE_KEYS is `required` (docs/security.md): without that, publish it on
# loopback only, or behind a proxy that knows its users.
ENTRYPOINT ["stillage"]
CMD ["serve", "--listen", "0.0.0.0:8080", "--allow-public", "--data", "/data"]
