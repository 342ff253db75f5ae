"""Many items on several cores or on a Dask cluster: none is lost if a worker ends."""
