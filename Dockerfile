# Any machine with Docker or Podman: docs/any_machine.md has the command that starts it. The launcher does the whole set-up.
FROM debian:12
COPY . /opt/course
RUN /opt/course/course --help
RUN useradd --create-home student
USER student
WORKDIR /home/student
EXPOSE 8888
CMD ["/opt/course/course", "lab", "--ip=0.0.0.0", "--no-browser"]
