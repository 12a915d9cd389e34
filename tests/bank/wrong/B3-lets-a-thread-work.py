"""Every ball with every other, in a thread whose lines nobody counts."""

# TODO B3: look only at bodies that share a cell
import _thread

pairs, done = [], _thread.allocate_lock()


def work():
    for number, body in enumerate(bodies):
        low, high = extent(body)
        for other in bodies[number + 1 :]:
            least, most = extent(other)
            if low.x <= most.x and least.x <= high.x and low.y <= most.y and least.y <= high.y:
                pairs.append((body, other))
    done.release()


done.acquire()
_thread.start_new_thread(work, ())
done.acquire()
return pairs
# END TODO B3
