"""Prints what a launch file starts, as json: usage dump_launch.py FILE [NAME:=VALUE...]

{"nodes": {name: {"type": "pkg/type", "remaps": {from: to}, "args": text, "required": bool, "respawn": bool, "prefix": text}}, "params": {name: value}}
"""
import json
import sys

import roslaunch.config
import roslaunch.xmlloader
import rosgraph.names


def main():
    file, *arguments = sys.argv[1:]
    config = roslaunch.config.ROSLaunchConfig()
    roslaunch.xmlloader.XmlLoader(resolve_anon=False).load(file, config, argv=arguments, verbose=False)
    nodes = {}
    for node in config.nodes:
        name = rosgraph.names.ns_join(node.namespace, node.name)
        own = {source: rosgraph.names.resolve_name(target, "/") for source, target in node.remap_args}
        nodes[name] = {"type": f"{node.package}/{node.type}", "remaps": own, "args": node.args,
                       "required": node.required, "respawn": node.respawn, "prefix": node.launch_prefix}
    params = {name: param.value for name, param in config.params.items()}
    json.dump({"nodes": nodes, "params": params, "errors": config.config_errors}, sys.stdout, default=str)


if __name__ == "__main__":
    main()
