"""Asks which keys are down, one by one."""

# TODO B6: heavier balls with Shift
keys = pygame.key.get_pressed()
return 10.0 if keys[pygame.K_LSHIFT] or keys[pygame.K_RSHIFT] else 1.0
# END TODO B6
