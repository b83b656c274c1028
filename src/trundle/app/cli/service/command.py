"""List, describe and call services, as rosservice does."""

import argparse

from trundle.ros import MasterError, MasterProxy, RosError, ServiceError

from ..graph_command import global_name, master, ros_errors

EXAMPLES = """
  trundle service list
  trundle service call /gazebo/pause_physics
  trundle service call /gazebo/get_model_state '{model_name: rp2w}'
  trundle service info /gazebo/pause_physics
  trundle service type /gazebo/pause_physics
  trundle service uri /gazebo/pause_physics
  trundle service node /gazebo/pause_physics
  trundle service args /gazebo/get_model_state
  trundle service find std_srvs/Empty
"""
_SCRIPT = "rosservice"


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.set_defaults(alone=2)
    commands = parser.add_subparsers(dest="command", required=True, metavar="COMMAND")
    add = commands.add_parser("list", help="names of all services")
    add.add_argument("namespace", nargs="?", help="namespace to list")
    add.add_argument("-n", "--nodes", action="store_true", help="with the nodes that provide them")
    add.set_defaults(run=_list)
    add = commands.add_parser("call", help="call a service and print its answer")
    add.add_argument("service", help="name of the service")
    add.add_argument("values", nargs="*", help="request as YAML, or its fields in order, or standard input")
    add.add_argument("-v", dest="verbose", action="store_true", help="also print the request")
    add.add_argument("--wait", action="store_true", help="wait for the service")
    add.set_defaults(run=_call, failure=2)
    for name, run, help_ in (
        ("info", _info, "node, address, type and arguments of a service"),
        ("type", _type, "type of a service"),
        ("uri", _uri, "address of a service"),
        ("node", _node, "node that provides a service"),
        ("args", _args, "names of a service's arguments"),
    ):
        add = commands.add_parser(name, help=help_)
        add.add_argument("service", help="name of the service")
        add.set_defaults(run=run, failure=2 if name == "args" else 1)
    add = commands.add_parser("find", help="services of a type")
    add.add_argument("type", help="type, as std_srvs/Empty")
    add.set_defaults(run=_find)


@ros_errors
def main(args: argparse.Namespace) -> int:
    """Run the subcommand."""
    return int(args.run(args))


def _list(args: argparse.Namespace) -> int:
    services = sorted(_services(master(_SCRIPT)))
    if args.namespace:
        name = global_name(args.namespace, _SCRIPT)
        services = [row for row in services if row[0] == name or row[0].startswith(name.rstrip("/") + "/")]
    for name, nodes in services:
        print(f"{name} {','.join(nodes)}" if args.nodes else name)
    return 0


def _info(args: argparse.Namespace) -> int:
    from .call import argument_names

    proxy, name = master(_SCRIPT), global_name(args.service, _SCRIPT)
    print(f"Node: {_provider(proxy, name)}")
    print(f"URI: {_address(proxy, name)}")
    kind = _type_of(proxy, name)
    print(f"Type: {kind}")
    print(f"Args: {argument_names(kind)}")
    return 0


def _type(args: argparse.Namespace) -> int:
    print(_type_of(master(_SCRIPT), global_name(args.service, _SCRIPT)))
    return 0


def _uri(args: argparse.Namespace) -> int:
    print(_address(master(_SCRIPT), global_name(args.service, _SCRIPT)))
    return 0


def _node(args: argparse.Namespace) -> int:
    print(_provider(master(_SCRIPT), global_name(args.service, _SCRIPT)))
    return 0


def _args(args: argparse.Namespace) -> int:
    from .call import argument_names

    print(argument_names(_type_of(master(_SCRIPT), global_name(args.service, _SCRIPT))))
    return 0


def _find(args: argparse.Namespace) -> int:
    proxy = master(_SCRIPT)
    names: list[str] = []
    for name, _ in _services(proxy):
        try:
            if _type_of(proxy, name) == args.type:
                names.append(name)
        except RosError:  # the provider has ended, or does not answer
            continue
    print("\n".join(names))
    return 0


def _services(proxy: MasterProxy) -> list[tuple[str, list[str]]]:
    return [(name, nodes) for name, nodes in proxy.call("getSystemState")[2]]


def _provider(proxy: MasterProxy, name: str) -> str:
    for service, nodes in _services(proxy):
        if service == name and nodes:
            return nodes[0]
    raise ServiceError(f"Unknown service: {name}")


def _address(proxy: MasterProxy, name: str) -> str:
    try:
        return str(proxy.call("lookupService", name))
    except MasterError:
        raise ServiceError(f"Unknown service: {name}") from None


def _type_of(proxy: MasterProxy, name: str) -> str:
    from .call import service_type

    return service_type(proxy, name)


def _call(args: argparse.Namespace) -> int:
    from .call import main

    return main(args)
