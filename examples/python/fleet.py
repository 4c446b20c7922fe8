"""A fleet manager: the way of a vehicle to a storage location, and the graph that it loads.

    python fleet.py http://127.0.0.1:8080/v1/maps/MAP X,Y CODE [FILE]

X,Y is where the vehicle stands, in metres of the map; CODE is a storage location. FILE receives the Layout Interchange
Format: lif.json when absent.
"""

import json
import pathlib
import sys

import requests


def get(address, **parameters):
    """The answer to a question; where the service refuses it, the program ends with the reason."""
    answer = requests.get(address, params=parameters, timeout=30)
    if not answer.ok:
        sys.exit(answer.json()["detail"])
    return answer


map_url, start, code = sys.argv[1:4]
file = pathlib.Path(sys.argv[4] if len(sys.argv) > 4 else "lif.json")

# A vehicle of 0.9 m in width. A map without a georeference has its own metres as EPSG:3857.
route = get(f"{map_url}/routes", **{"from": start, "to": f"location:{code}", "crs": "EPSG:3857", "footprintRadiusM": 0.45})
way = route.json()["properties"]
print(f"{way['lengthM']:.1f} m in {way['timeS']:.0f} s, {way['clearanceM']:.2f} m from the nearest obstacle")
for step in way["instructions"]:
    print(f"  ({step['pose']['x']:7.2f}, {step['pose']['y']:7.2f})  {step['text']}")

file.write_bytes(get(f"{map_url}/exports/lif.json", footprintRadiusM=0.45).content)
layout = json.loads(file.read_text())["layouts"][0]
print(f"{file}: {len(layout['nodes'])} nodes, {len(layout['edges'])} edges, {len(layout['stations'])} stations")
