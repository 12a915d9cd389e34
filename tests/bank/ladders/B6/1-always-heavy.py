"""Heavy, whatever is held."""

# TODO B6: heavier balls with Shift
return 10 if pygame.KMOD_SHIFT else 1
# END TODO B6
