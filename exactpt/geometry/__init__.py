"""One instant: points, predicates, polygons."""
