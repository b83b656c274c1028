from .plugin import FetchGazebo as FetchGazebo
