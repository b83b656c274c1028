"""Pages and pictures of the site generated from the code; `hooks` adds them to the build."""
