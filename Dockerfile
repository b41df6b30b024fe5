# An image whose containers run the demo. Its report lands in the folder demo_out:
#   docker build -t suspension_health_monitor .
#   docker run --rm -v "$PWD/demo_out:/demo_out" suspension_health_monitor
FROM debian:bookworm
WORKDIR /suspension_health_monitor
# Only what installing needs: a change of the sources installs nothing anew.
COPY package.xml ./
COPY rosdep rosdep
COPY scripts scripts
RUN scripts/install_dependencies --demo && rm -rf /var/lib/apt/lists/*
COPY . .
RUN bash -c "source scripts/common.sh && buildPackage"
CMD ["scripts/demo", "--quick", "--no-install", "--output", "/demo_out"]
