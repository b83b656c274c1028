"""Machines that nodes run on."""

_TIMEOUT_S = 10.0
_LOCAL = ("localhost", "127.0.0.1", "::1")


class Machine:
    """A machine of a launch file."""

    def __init__(
        self,
        name: str,
        address: str,
        env_loader: str | None = None,
        ssh_port: int = 22,
        user: str | None = None,
        password: str | None = None,
        assignable: bool = True,
        env_args: object = (),
        timeout: float | None = None,
    ) -> None:
        del env_args
        self.name = name
        self.address = address
        self.env_loader = env_loader
        self.ssh_port = ssh_port
        self.user = user or None
        self.password = password
        self.assignable = assignable
        self.timeout = timeout or _TIMEOUT_S

    def config_key(self) -> str:
        """Configuration as text; equal for equally configured machines."""
        return (
            f"Machine(address[{self.address}] env_loader[{self.env_loader}] ssh_port[{self.ssh_port}] "
            f"user[{self.user or ''}] password[{self.password or ''}] timeout[{self.timeout}])"
        )

    def config_equals(self, m2: object) -> bool:
        """True if another machine has the same configuration."""
        return isinstance(m2, Machine) and self.config_key() == m2.config_key()

    __hash__ = None  # pyright: ignore[reportAssignmentType] - it changes

    def __eq__(self, other: object) -> bool:
        same = isinstance(other, Machine) and (self.name, self.assignable) == (other.name, other.assignable)
        return same and self.config_equals(other)

    def __str__(self) -> str:
        return (
            f"Machine(name[{self.name}] env_loader[{self.env_loader}] address[{self.address}] "
            f"ssh_port[{self.ssh_port}] user[{self.user}] assignable[{self.assignable}] timeout[{self.timeout}])"
        )


def local_machine() -> Machine:
    """Machine of this process."""
    return Machine("", "localhost")


def is_machine_local(machine: Machine) -> bool:
    """True for this machine."""
    return machine.address in _LOCAL
