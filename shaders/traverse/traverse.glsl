// Walks the hierarchy: the only trace site of a kernel. It stops at a budget of steps and can go on in a later dispatch,
// because some drivers silently end loops that run long (docs/architecture.md).

#define NODE_NONE 0xffffffffu

// The stack lives in shared memory on a CPU device and in private memory on a GPU: each is twice as fast there as the other.
shared uint sharedStack[SHARED_STACK_WORDS];
uint privateStack[PRIVATE_STACK_WORDS];

void stackWrite(int level, uint word) {
    if (STACK_IS_SHARED)
        sharedStack[level * int(gl_WorkGroupSize.x) + int(gl_LocalInvocationIndex)] = word;
    else
        privateStack[level] = word;
}

uint stackRead(int level) {
    if (STACK_IS_SHARED) return sharedStack[level * int(gl_WorkGroupSize.x) + int(gl_LocalInvocationIndex)];
    return privateStack[level];
}

/// A ray on its way: what is left to visit and the best hit so far.
struct Traversal {
    vec3 origin;
    vec3 direction;
    bool anyHit;  // any occluder will do
    uint node;    // next to visit; NODE_NONE when done
    int level;    // entries on the stack
    float t;      // of the best hit, or the end of the ray
    uint slot;    // of the best hit, or MINIRT_NONE
};

Traversal beginTraversal(vec3 origin, vec3 direction, float tMax, bool anyHit) {
    return Traversal(origin, direction, anyHit, 0u, 0, tMax, MINIRT_NONE);
}

/// No ray: done from the start.
Traversal noRay() {
    Traversal none = beginTraversal(vec3(0.0), vec3(0.0, 0.0, 1.0), 0.0, true);
    none.node = NODE_NONE;
    return none;
}

bool isDone(Traversal traversal) { return traversal.node == NODE_NONE; }

uint popNode(inout int level) {
    level--;
    return level >= 0 ? stackRead(max(level, 0)) : NODE_NONE;
}

/// All primitives of a leaf.
void intersectLeaf(inout Traversal ray, Shear shear, uint leaf, inout uint steps) {
    uint slot = (leaf & ~MINIRT_LEAF) >> 3;
    uint end = slot + (leaf & 7u) + 1u;
    do {
        steps++;
        PrimitiveHit found = intersectPrimitive(slot, ray.origin, ray.direction, shear, ray.t);
        ray.t = found.hit ? found.t : ray.t;
        ray.slot = found.hit ? slot : ray.slot;
        slot++;
    } while (slot < end);
}

/// Visits nodes until the ray is done or `steps` reaches `budget`. Counts a step for every pass of every loop, as some drivers do. Loops test
/// at their end: where a driver masks lanes, a pass that only finds the condition false costs as much as any other.
void traverse(inout Traversal ray, inout uint steps, uint budget) {
    SlabRay slabs = slabRay(ray.origin, ray.direction, scene.gridOrigin.xyz, scene.gridScale.xyz, scene.gridPlanes.xyz);
    Shear shear = shearOf(ray.direction);
    uint node = ray.node;
    int level = ray.level;
    if (node != NODE_NONE) {  // a ray that is done takes one step, so that whoever waits for it gets on under any budget
        do {
            if ((node & MINIRT_LEAF) == 0u) {
                do {
                    steps++;
                    ChildBoxes boxes = fetchNode(node);
                    BoxHit hit0 = intersectBox(slabs, boxes.lo0, boxes.hi0, ray.t);
                    BoxHit hit1 = intersectBox(slabs, boxes.lo1, boxes.hi1, ray.t);
                    bool secondFirst = hit1.hit && (hit1.tNear < hit0.tNear || !hit0.hit);
                    node = secondFirst ? boxes.ref1 : boxes.ref0;
                    if (hit0.hit && hit1.hit) stackWrite(level, secondFirst ? boxes.ref0 : boxes.ref1);
                    level += int(hit0.hit && hit1.hit);
                    if (!(hit0.hit || hit1.hit)) node = popNode(level);
                } while ((node & MINIRT_LEAF) == 0u && steps < budget);
            }
            if (node != NODE_NONE && (node & MINIRT_LEAF) != 0u) {
                do {
                    intersectLeaf(ray, shear, node, steps);
                    node = popNode(level);
                    if (ray.anyHit && ray.slot != MINIRT_NONE) node = NODE_NONE;
                    steps++;
                } while (node != NODE_NONE && (node & MINIRT_LEAF) != 0u && steps < budget);
            }
            // This pass, and those of the loops inside where all lanes of a subgroup are masked; at the end, so that any budget makes progress.
            steps += 4u;
        } while (node != NODE_NONE && steps < budget);
    }
    steps++;
    ray.node = node;
    ray.level = level;
}
