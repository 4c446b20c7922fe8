"""What the Python client of openapi-generator makes of a service: openapi_generator.py MAP_URL."""

import sys

import stillage_client as stillage

service, map_id = sys.argv[1].split("/v1/maps/")
with stillage.ApiClient(stillage.Configuration(host=service)) as client:
    maps, features, fleet = stillage.MapsApi(client), stillage.FeaturesApi(client), stillage.FleetApi(client)

    listed = [str(one.id) for one in maps.list_maps().maps]
    assert map_id in listed, listed
    assert maps.get_map(map_id).width == 1042
    assert bytes(maps.get_image(map_id)).startswith(b"\x89PNG")

    page = features.get_features_of_faces(map_id, label="co", crs="EPSG:3857", limit=10)
    assert page.number_returned == 5 and page.features[0].properties["label"] == "co", page

    route = fleet.get_route(map_id, var_from="-15,-5", to="location:02-007", crs="EPSG:3857")
    assert route.properties.length_m > 10 and route.properties.instructions[0].action == "depart", route.properties
