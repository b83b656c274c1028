#error "Trundle's kit has no rendering interface: the page draws; markers of rviz show what a plugin wants to show"
