"""Pages and pictures of the site that are made from the code; `hooks` adds them to the build."""
