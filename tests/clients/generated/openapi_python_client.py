"""What the client of openapi-python-client makes of a service: openapi_python_client.py MAP_URL."""

import sys
from uuid import UUID

from stillage_client import Client
from stillage_client.api.features import get_features_of_faces
from stillage_client.api.fleet import get_route
from stillage_client.api.maps import get_image, get_map, list_maps
from stillage_client.models import CrsName

service, map_id = sys.argv[1].split("/v1/maps/")
map_id = UUID(map_id)
client = Client(base_url=service, raise_on_unexpected_status=True)

assert map_id in [one.id for one in list_maps.sync(client=client).maps]
assert get_map.sync(map_id, client=client).width == 1042
assert get_image.sync(map_id, client=client).payload.read().startswith(b"\x89PNG")

page = get_features_of_faces.sync(map_id, client=client, label="co", crs=CrsName.EPSG3857, limit=10)
assert page.number_returned == 5 and page.features[0].properties["label"] == "co", page

route = get_route.sync(map_id, client=client, from_="-15,-5", to="location:02-007", crs=CrsName.EPSG3857)
assert route.properties.length_m > 10 and route.properties.instructions[0].action == "depart", route.properties
