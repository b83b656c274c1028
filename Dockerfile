# Trundle without a display: docker build -t trundle . && docker run --rm trundle run rp2w_at_home.world --headless --duration 5
FROM python:3.12-slim AS build
RUN apt-get update \
 && apt-get install -y --no-install-recommends g++ \
 && rm -rf /var/lib/apt/lists/*
WORKDIR /source
COPY . .
RUN python -m venv /opt/trundle \
 && /opt/trundle/bin/pip install --no-cache-dir --constraint constraints.txt . \
 && find /opt/trundle -name __pycache__ -prune -exec rm -rf {} + \
 && /opt/trundle/bin/pip uninstall --yes pip

FROM python:3.12-slim
COPY --from=build /opt/trundle /opt/trundle
RUN useradd --create-home trundle
USER trundle
WORKDIR /home/trundle
ENV PATH=/opt/trundle/bin:$PATH PYTHONUNBUFFERED=1
# The ROS master and the page of `trundle run`; both are loopback unless --host says otherwise.
EXPOSE 11311 8080
ENTRYPOINT ["trundle"]
CMD ["--help"]
